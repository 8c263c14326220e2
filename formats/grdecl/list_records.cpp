// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <span>
#include <unordered_map>

#include "base/text_cursor.h"
#include "formats/drop.h"
#include "formats/grdecl/flow_words.h"

namespace geomend::grdecl {

namespace {

using Fault = CornerPointGrid::Fault;

constexpr std::array<std::string_view, 7> directions = {"X", "Y", "Z", "XY", "YZ", "XZ", "XYZ"};

bool among(std::span<const std::string_view> words, std::string_view word) { return std::ranges::find(words, word) != words.end(); }

/// X, X+, I, I+ and their like; the letter alone is the + side.
std::optional<CellFace> face_of(std::string_view text) {
    const std::string word = upper_case(trimmed(text));
    if (word.empty() || word.size() > 2) return {};
    const std::size_t axis = std::string_view("XYZIJK").find(word[0]);
    if (axis == std::string_view::npos || (word.size() == 2 && word[1] != '+' && word[1] != '-')) return {};
    const bool minus = word.size() == 2 && word[1] == '-';
    return static_cast<CellFace>(2 * (axis % 3) + (minus ? 0 : 1));
}

OptionalFailure take_fault_box(const Scanner& in, const Record& record, Fault::Box& box, std::vector<Finding>& findings) {
    constexpr std::array<std::string_view, 6> names = {"I1", "I2", "J1", "J2", "K1", "K2"};
    for (std::size_t n = 0; n < 6; ++n) {
        std::int64_t value = 0;
        if (auto failed = need_whole(in, record, 1 + n, "name, I1 I2 J1 J2 K1 K2 and face of a fault", value)) return failed;
        if (value < 1 || value > 2'000'000'000)
            return unreadable("F012", in.location(record.items[1 + n].at),
                              "expected " + std::string(names[n]) + " from 1, found " + std::to_string(value));
        (n % 2 == 0 ? box.first : box.last)[n / 2] = static_cast<std::uint32_t>(value - 1);
    }
    if (!record.given(7)) return unreadable("F012", in.location(record.slash), "expected the face of a fault, found the end of the record");
    const auto face = face_of(record.text(7));
    if (!face)
        return unreadable("F012", in.location(record.items[7].at),
                          "expected a face (X, X-, Y, I, J-, ...), found " + shown(record.text(7)));
    box.face = *face;
    static_cast<void>(take_word(in, record, 7, "the face of a fault", findings));
    return {};
}

OptionalFailure take_cell(const Scanner& in, const Record& record, std::size_t i, const Dims& dims, std::uint64_t& cell) {
    constexpr std::array<std::string_view, 3> names = {"I", "J", "K"};
    std::array<std::uint64_t, 3> ijk{};
    for (std::size_t a = 0; a < 3; ++a) {
        std::int64_t value = 0;
        if (auto failed = need_whole(in, record, i + a, "I J K of two cells", value)) return failed;
        if (value < 1 || value > dims[a]) {
            return unreadable("F007", in.location(record.items[i + a].at),
                              "expected " + std::string(names[a]) + " of a cell from 1 to " + std::to_string(dims[a]) + ", found " +
                                  std::to_string(value));
        }
        ijk[a] = static_cast<std::uint64_t>(value - 1);
    }
    cell = ijk[0] + dims[0] * (ijk[1] + std::uint64_t{dims[1]} * ijk[2]);
    return {};
}

}  // namespace

bool list_ends(Scanner& in, std::string_view keyword, std::vector<Finding>& findings, OptionalFailure& trouble) {
    if (in.take_slash()) return true;
    if (std::string_view word; in.word_alone_follows(word) && is_known(word)) {
        if (std::ranges::find(findings, "F147", &Finding::code) == findings.end())
            findings.push_back(finding("F147", in.here(), "the list of " + std::string(keyword) + " has no '/' at its end"));
        return true;
    }
    if (in.skip()) return false;
    const std::string_view bytes = in.input().bytes();
    if (!bytes.empty() && bytes.back() == '\n')
        findings.push_back(finding("F101", in.here(), "the list of " + std::string(keyword) + " has no '/' at its end"));
    else
        trouble =
            unreadable("F004", in.here(), "expected a '/' that ends the list of " + std::string(keyword) + ", found the end of the file");
    return true;
}

OptionalFailure read_faults(Scanner& in, GridText& g, std::vector<Finding>& findings) {
    std::unordered_map<std::string, std::size_t> known;
    for (std::size_t f = 0; f < g.grid.faults.size(); ++f) known.emplace(g.grid.faults[f].name, f);
    return read_list(in, "FAULTS", findings, [&](const Record& record) -> OptionalFailure {
        if (!record.given(0)) return unreadable("F012", in.location(record.begin), "expected the name of a fault");
        Fault::Box box{};
        if (auto failed = take_fault_box(in, record, box, findings)) return failed;
        std::string name(trimmed(record.text(0)));
        const auto [place, is_new] = known.emplace(name, g.grid.faults.size());
        if (is_new) g.grid.faults.push_back({std::move(name), {}, {}, {}});
        g.grid.faults[place->second].boxes.push_back(box);
        return {};
    });
}

OptionalFailure read_fault_multipliers(Scanner& in, GridText& g, bool in_edit, std::vector<Finding>& findings) {
    const auto set = [&](Fault& fault, double value) { (in_edit ? fault.edit_multiplier : fault.multiplier) = value; };
    std::unordered_map<std::string, std::size_t> known;
    for (std::size_t f = 0; f < g.grid.faults.size(); ++f) known.emplace(g.grid.faults[f].name, f);
    return read_list(in, "MULTFLT", findings, [&](const Record& record) -> OptionalFailure {
        if (!record.given(0)) return unreadable("F012", in.location(record.begin), "expected the name of a fault");
        double value = 1;
        if (auto failed = take_real(in, record, 1, "a multiplier", value)) return failed;
        if (!record.given(1)) note_flow_stops(findings, in.location(record.slash), "a record of MULTFLT has no multiplier");
        const std::string name(trimmed(record.text(0)));
        if (name.ends_with('*')) {
            note_flow_stops(findings, in.location(record.items[0].at), "a record of MULTFLT names faults by a '*'");
            const std::string_view stem = std::string_view(name).substr(0, name.size() - 1);
            bool met = false;
            for (Fault& fault : g.grid.faults) {
                if (!fault.name.starts_with(stem)) continue;
                set(fault, value);
                met = true;
            }
            if (met) return {};
        }
        // A fault that is not here has its faces in another include.
        const auto [place, is_new] = known.emplace(name, g.grid.faults.size());
        if (is_new) g.grid.faults.push_back({name, {}, {}, {}});
        set(g.grid.faults[place->second], value);
        return {};
    });
}

OptionalFailure read_connections(Scanner& in, GridText& g, std::vector<Finding>& findings, std::vector<Loss>& losses) {
    std::uint64_t more = 0;
    Location first_more;
    auto failed = read_list(in, "NNC", findings, [&](const Record& record) -> OptionalFailure {
        CornerPointGrid::Connection c;
        if (auto wrong = take_cell(in, record, 0, *g.dims, c.first)) return wrong;
        if (auto wrong = take_cell(in, record, 3, *g.dims, c.second)) return wrong;
        double value = 0;
        if (auto wrong = take_real(in, record, 6, "a transmissibility", value)) return wrong;
        if (record.given(6)) c.transmissibility = value;
        for (std::size_t i = 7; i < record.items.size(); ++i) {
            if (!record.given(i)) continue;
            if (more++ == 0) first_more = in.location(record.items[i].at);
            break;
        }
        g.grid.connections.push_back(c);
        return {};
    });
    if (more > 0)
        drop(findings, losses,
             {LossClass::substance, g.grid.info.name, "further items of stated connections (tables, faces, areas)",
              "only cells and transmissibility are kept", more, first_more});
    return failed;
}

OptionalFailure read_connection_factors(Scanner& in, GridText& g, std::vector<Finding>& findings) {
    return read_list(in, "EDITNNC", findings, [&](const Record& record) -> OptionalFailure {
        CornerPointGrid::ConnectionFactor c;
        if (auto wrong = take_cell(in, record, 0, *g.dims, c.first)) return wrong;
        if (auto wrong = take_cell(in, record, 3, *g.dims, c.second)) return wrong;
        if (auto wrong = take_real(in, record, 6, "a multiplier", c.value)) return wrong;
        g.grid.connection_factors.push_back(c);
        return {};
    });
}

OptionalFailure read_region_multipliers(Scanner& in, GridText& g, std::vector<Finding>& findings) {
    return read_list(in, "MULTREGT", findings, [&](const Record& record) -> OptionalFailure {
        CornerPointGrid::RegionMultiplier m;
        std::int64_t from = 0, to = 0;
        if (auto failed = take_whole(in, record, 0, "a region", from)) return failed;
        if (auto failed = take_whole(in, record, 1, "a region", to)) return failed;
        if (auto failed = take_real(in, record, 2, "a multiplier", m.value)) return failed;
        if (from > 0 && from < 2147483647) m.from = static_cast<int>(from);
        if (to > 0 && to < 2147483647) m.to = static_cast<int>(to);
        if (from == 0 && to == 0 && record.given(0) && record.given(1))
            note_flow_stops(findings, in.location(record.begin), "MULTREGT has a multiplier within region 0");
        if (record.given(3)) {
            m.directions = take_word(in, record, 3, "the directions of MULTREGT", findings);
            if (!among(directions, m.directions))
                note_flow_stops(findings, in.location(record.items[3].at), "MULTREGT has the directions " + shown(m.directions));
        }
        if (record.given(4)) {
            m.connections = take_word(in, record, 4, "the kind of connections of MULTREGT", findings);
            if (m.connections != "ALL" && m.connections != "NNC" && m.connections != "NONNC")
                note_flow_stops(findings, in.location(record.items[4].at), "MULTREGT has the kind of connections " + shown(m.connections));
        }
        if (record.given(5)) {
            const std::string word = take_word(in, record, 5, "the kind of regions of MULTREGT", findings);
            if (word != "M" && word != "F" && word != "O")
                return unreadable("F012", in.location(record.items[5].at), "expected M, F or O, found " + shown(record.text(5)));
            m.regions = word[0];
        } else {
            m.regions = letter_of_regions(g);
        }
        g.grid.region_multipliers.push_back(std::move(m));
        return {};
    });
}

}  // namespace geomend::grdecl
