// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>

#include "formats/drop.h"
#include "formats/gocad/model3d.h"
#include "formats/gocad/node_ids.h"
#include "formats/gocad/object_head.h"

namespace geomend::gocad {

namespace {

constexpr std::int64_t largest_number = 1'000'000'000'000;

class Model3dReader {
public:
    explicit Model3dReader(ObjectScanner& scanner) : scanner_(scanner), log_(scanner.log), head_(scanner), line_(scanner.text()) {}

    Result<Model3dClaims> run() {
        while (line_.next_line()) {
            take_line();
            if ((line_.line() & 0xfff) == 0 && scanner_.stopped()) return scanner_.stop();
        }
        resolve();
        head_.finish();
        StatedModel& model = claims_.model;
        model.name = std::move(head_.info.name);
        model.crs = std::move(head_.info.crs);
        model.annotations = std::move(head_.info.annotations);
        for (StatedModel::Face& face : model.faces) {
            if (!face.key || model.crs.z_positive != ZPositive::depth) continue;
            for (Vec3& corner : *face.key) corner[2] = -corner[2];
        }
        return std::move(claims_);
    }

private:
    struct List {
        std::vector<std::int64_t> numbers;
        std::uint64_t line = 0;
    };

    void take_line() {
        const std::string_view keyword = line_.token();
        if (keyword.empty()) return;
        const auto is = [&](std::string_view word) { return same_word(keyword, word); };
        if (is("TSURF")) {
            claims_.tsurfs.push_back({name_to_line_end(), line_.line()});
        } else if (is("TFACE")) {
            read_face();
        } else if (is("REGION")) {
            read_region();
        } else if (is("SURFACE")) {
            const std::string name = name_to_line_end();
            claims_.model.features.push_back({name, {}});
            features_.push_back(read_list("SURFACE"));
        } else if (is("LAYER")) {
            claims_.model.layers.push_back({name_to_line_end(), {}, {}});
            layers_.push_back(read_list("LAYER"));
        } else if (is("FAULT_BLOCK")) {
            claims_.model.fault_blocks.push_back({name_to_line_end(), {}, {}});
            fault_blocks_.push_back(read_list("FAULT_BLOCK"));
        } else {
            head_.take(keyword, line_);
        }
    }

    // Names run to the end of the line, in quotes or not.
    std::string name_to_line_end() {
        std::string_view text = line_.rest();
        if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = trimmed(text.substr(1, text.size() - 2));
        return std::string(text);
    }

    bool read_number(std::int64_t& number, std::string_view what) {
        line_.at_line_end();
        const std::uint32_t column = line_.column();
        if (line_.integer(number) == NumberStatus::ok && number > -largest_number && number < largest_number) return true;
        log_.add(
            "F012", line_.line(), column,
            [&] { return "expected a number after " + std::string(what) + ", found '" + std::string(trimmed(line_.line_text())) + "'"; },
            what);
        return false;
    }

    void add_number(NodeIds& numbers, std::int64_t number, std::string_view what) {
        if (numbers.add(number)) return;
        log_.add(
            "F009", line_.line(), 0, [&] { return std::string(what) + ' ' + std::to_string(number) + " is defined twice"; }, what, number);
    }

    void read_face() {
        StatedModel::Face face;
        face.line = line_.line();
        if (read_number(face.number, "TFACE")) add_number(face_numbers_, face.number, "TFACE");
        face.role_text = line_.token();
        face.role = feature_role(face.role_text);
        face.interface_name = name_to_line_end();
        read_key(face);
        claims_.model.faces.push_back(std::move(face));
    }

    // Nine numbers, three to a line as Gocad writes them.
    void read_key(StatedModel::Face& face) {
        std::array<Vec3, 3> key{};
        for (std::size_t i = 0; i != 9; ++i) {
            while (line_.at_line_end()) {
                const char* here = line_.next_line_begin();
                const std::uint64_t number = line_.line() + 1;
                if (line_.next_line() && (line_.at_line_end() || starts_number())) continue;
                line_.jump(here, number);
                const std::uint64_t at = face.line;
                const auto text = [&] {
                    return "TFACE " + std::to_string(face.number) + ": expected a key triangle of nine numbers, found " + std::to_string(i);
                };
                if (i == 0) log_.add("F118", at, 0, text, "key");
                else log_.add("F012", at, 0, text, "key");
                return;
            }
            const std::uint32_t column = line_.column();
            double& value = key[i / 3][i % 3];
            if (line_.real(value) != NumberStatus::ok) {
                return log_.add(
                    "F005", line_.line(), column,
                    [&] { return "expected a coordinate of a key triangle, found '" + std::string(trimmed(line_.line_text())) + "'"; },
                    "key");
            }
            if (!std::isfinite(value)) {
                return log_.add("F006", line_.line(), column, "a coordinate of a key triangle is not finite", "key");
            }
        }
        face.key = key;
    }

    // Whether a number (finite or not) rather than a keyword is next.
    bool starts_number() const {
        const std::string_view rest = line_.peek_rest();
        const char c = rest.empty() ? ' ' : rest.front();
        if (c == '+' || c == '-' || c == '.' || (c >= '0' && c <= '9')) return true;
        return same_word(rest.substr(0, 3), "nan") || same_word(rest.substr(0, 3), "inf");
    }

    void read_region() {
        StatedModel::Region region;
        if (read_number(region.number, "REGION")) add_number(region_numbers_, region.number, "REGION");
        region.name = name_to_line_end();
        region.universe = same_word(region.name, "Universe");
        claims_.model.regions.push_back(std::move(region));
        regions_.push_back(read_list("REGION"));
    }

    // Numbers up to 0, over any number of lines.
    List read_list(std::string_view what) {
        List list;
        list.line = line_.line();
        for (;;) {
            const char* here = line_.next_line_begin();
            const std::uint64_t number = line_.line() + 1;
            if (!line_.next_line()) break;
            if (line_.at_line_end() || line_.peek_rest().front() == '#') continue;
            if (!starts_number()) {
                line_.jump(here, number);
                break;
            }
            while (!line_.at_line_end()) {
                std::int64_t value = 0;
                if (!read_number(value, what)) break;
                if (value == 0) return list;
                list.numbers.push_back(value);
            }
        }
        log_.add(
            "F108", list.line, 0, [&] { return "this " + std::string(what) + " list does not end with 0"; }, what);
        return list;
    }

    void unknown_number(const char* code, const List& list, std::string_view what, std::string_view of, std::int64_t number) {
        log_.add(
            code, list.line, 0,
            [&] { return std::string(what) + " names " + std::string(of) + ' ' + std::to_string(number) + ", which has no record"; }, what,
            number);
    }

    void resolve() {
        StatedModel& model = claims_.model;
        for (std::size_t r = 0; r != regions_.size(); ++r) {
            for (const std::int64_t number : regions_[r].numbers) {
                const std::uint32_t face = face_numbers_.find(number < 0 ? -number : number);
                if (face == no_index) unknown_number("F007", regions_[r], "REGION", "TFACE", number);
                else model.regions[r].sides.push_back({face, number > 0});
            }
        }
        for (std::size_t f = 0; f != features_.size(); ++f) {
            for (const std::int64_t number : features_[f].numbers) {
                const std::uint32_t face = face_numbers_.find(number < 0 ? -number : number);
                if (face != no_index) {
                    model.features[f].faces.push_back(face);
                    continue;
                }
                unknown_number("F109", features_[f], "SURFACE", "TFACE", number);
                list_dropped(scanner_.losses,
                             {LossClass::identity, model.features[f].name, "numbers of a SURFACE list without a TFACE", {}});
            }
        }
        resolve_regions(layers_, model.layers, "LAYER");
        resolve_regions(fault_blocks_, model.fault_blocks, "FAULT_BLOCK");
    }

    void resolve_regions(const std::vector<List>& lists, std::vector<StatedModel::RegionList>& out, std::string_view what) {
        for (std::size_t i = 0; i != lists.size(); ++i) {
            for (const std::int64_t number : lists[i].numbers) {
                const std::uint32_t region = region_numbers_.find(number);
                if (region != no_index) {
                    out[i].regions.push_back(region);
                } else {
                    out[i].unresolved.push_back(number);
                    unknown_number("F109", lists[i], what, "REGION", number);
                }
            }
        }
    }

    ObjectScanner& scanner_;
    ObjectLog& log_;
    ObjectHead head_;
    TextCursor line_;
    Model3dClaims claims_;
    NodeIds face_numbers_, region_numbers_;
    std::vector<List> regions_, features_, layers_, fault_blocks_;
};

}  // namespace

Result<Model3dClaims> read_model3d(ObjectScanner& scanner) { return Model3dReader(scanner).run(); }

}  // namespace geomend::gocad
