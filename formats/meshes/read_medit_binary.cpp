// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/read_medit_binary.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "formats/drop.h"
#include "formats/meshes/medit_binary.h"
#include "formats/meshes/mesh_reading.h"
#include "formats/text_reading.h"

namespace geomend::meshes {

namespace {

constexpr std::string_view lowest_first("\1\0\0\0", 4), highest_first("\0\0\0\1", 4);

class Reader {
public:
    Reader(const Input& input, const ReadOptions& options)
        : input_(input), options_(options), bytes_(input.bytes()), swapped_(bytes_.starts_with(highest_first)) {}

    Result<Dataset> run() {
        std::int64_t cookie = 0;
        if (!take(4, cookie) || !take(4, version_)) return cut_short("the version");
        if (version_ < 1 || version_ > 4)
            return unreadable("F013", where(), "version " + std::to_string(version_) + " of binary Medit files: 1 to 4 are read");
        for (bool is_last = false; !is_last;) {
            if (auto failed = section(is_last)) return std::move(*failed);
        }
        if (auto failed = add_cells()) return std::move(*failed);
        grown_.finish();
        grown_.mesh.info.name = name_of(input_);
        if (version_ == 1) grown_.mesh.info.precision = CoordinatePrecision::single_precision;
        data_.objects.emplace_back(std::move(grown_.mesh));
        return std::move(data_);
    }

private:
    /// Cells wait for the vertices, which may follow them.
    struct Waiting {
        const MeditCells* section;
        std::vector<std::int64_t> numbers;  ///< nodes and reference of each
    };

    const Input& input_;
    const ReadOptions& options_;
    std::string_view bytes_;
    bool swapped_ = false;
    std::size_t at_ = 0;
    std::int64_t version_ = 0;
    GrowingMesh grown_;
    Dataset data_;
    std::vector<Waiting> waiting_;

    Location where() const { return {input_.name(), 0, 0, static_cast<std::int64_t>(at_)}; }
    Failure cut_short(const std::string& what) const { return unreadable("F004", where(), "the file ends before " + what); }
    bool is_stopped(std::uint64_t i) const { return i % 16384 == 0 && options_.monitor != nullptr && options_.monitor->stopped(); }
    std::size_t number_size() const { return version_ == 4 ? 8 : 4; }

    bool take_bits(std::size_t size, std::uint64_t& bits) {
        if (bytes_.size() - at_ < size) return false;
        bits = 0;
        for (std::size_t b = 0; b < size; ++b) {
            const std::size_t shift = 8 * (swapped_ ? size - 1 - b : b);
            bits |= std::uint64_t{static_cast<unsigned char>(bytes_[at_ + b])} << shift;
        }
        at_ += size;
        return true;
    }
    bool take(std::size_t size, std::int64_t& value) {
        std::uint64_t bits = 0;
        if (!take_bits(size, bits)) return false;
        value = size == 4 ? static_cast<std::int32_t>(static_cast<std::uint32_t>(bits)) : static_cast<std::int64_t>(bits);
        return true;
    }
    bool take_real(double& value) {
        std::uint64_t bits = 0;
        if (!take_bits(version_ == 1 ? 4 : 8, bits)) return false;
        value = version_ == 1 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits))) : std::bit_cast<double>(bits);
        return true;
    }

    std::optional<Failure> section(bool& is_last) {
        std::int64_t number = 0, next = 0, count = 0;
        if (!take(4, number)) {
            data_.findings.push_back(make_finding("F101", "the file has no section End: it may have been cut short", where(), 0));
            is_last = true;
            return std::nullopt;
        }
        if (!take(version_ >= 3 ? 8 : 4, next)) return cut_short("the place of the next section");
        is_last = number == static_cast<std::int64_t>(MeditSection::end);
        if (is_last) return std::nullopt;
        if (next != 0 && (next < static_cast<std::int64_t>(at_) || static_cast<std::uint64_t>(next) > bytes_.size()))
            return unreadable(
                "F014", where(),
                "section " + std::to_string(number) + " ends at byte " + std::to_string(next) + ", which is before it or beyond the file");
        is_last = next == 0;
        if (number == static_cast<std::int64_t>(MeditSection::dimension)) {
            if (!take(4, count)) return cut_short("the dimension");
            if (count != 3) return unreadable("F013", where(), "a mesh of dimension " + std::to_string(count) + ": only three are read");
        } else if (auto failed = counted_section(number)) {
            return failed;
        }
        if (next != 0) at_ = static_cast<std::size_t>(next);
        return std::nullopt;
    }

    std::optional<Failure> counted_section(std::int64_t number) {
        const auto cells = std::ranges::find(medit_cells, static_cast<std::int32_t>(number), &MeditCells::number);
        const bool is_vertices = number == static_cast<std::int64_t>(MeditSection::vertices);
        std::int64_t count = 0;
        if (!take(number_size(), count)) return cut_short("the count of section " + std::to_string(number));
        if (!is_vertices && cells == medit_cells.end()) {
            drop(data_.findings, data_.losses,
                 {.what = "section " + std::to_string(number),
                  .why = "it is not among those that are known",
                  .count = static_cast<std::uint64_t>(std::max<std::int64_t>(count, 1)),
                  .where = where()});
            return std::nullopt;
        }
        const std::size_t each = is_vertices ? 3 * (version_ == 1 ? 4 : 8) + number_size() : number_size() * (node_count(cells->type) + 1);
        if (count < 0 || static_cast<std::uint64_t>(count) > (bytes_.size() - at_) / each)
            return unreadable(
                "F014", where(),
                std::to_string(count) + " entries of section " + std::to_string(number) + " are announced, more than the file can hold");
        return is_vertices ? vertices(static_cast<std::uint64_t>(count)) : take_cells(*cells, static_cast<std::uint64_t>(count));
    }

    std::optional<Failure> vertices(std::uint64_t count) {
        if (!grown_.mesh.points.empty()) return unreadable("F012", where(), "expected one section of vertices, found a second one");
        grown_.mesh.points.reserve(count);
        for (std::uint64_t i = 0; i < count; ++i) {
            if (is_stopped(i)) return stopped(input_);
            std::int64_t reference = 0;
            for (double& x : grown_.mesh.points.emplace_back()) {
                if (!take_real(x)) return cut_short("the end of the vertices");
                if (!std::isfinite(x)) return unreadable("F006", where(), "a coordinate is not finite");
            }
            if (!take(number_size(), reference)) return cut_short("the end of the vertices");
        }
        return std::nullopt;
    }

    std::optional<Failure> take_cells(const MeditCells& section, std::uint64_t count) {
        Waiting& waiting = waiting_.emplace_back(Waiting{&section, {}});
        waiting.numbers.resize(count * (node_count(section.type) + 1));
        for (std::size_t i = 0; i < waiting.numbers.size(); ++i) {
            if (is_stopped(i)) return stopped(input_);
            if (!take(number_size(), waiting.numbers[i])) return cut_short("the end of section " + std::to_string(section.number));
        }
        return std::nullopt;
    }

    std::optional<Failure> add_cells() {
        std::array<std::uint32_t, 8> nodes{};
        for (const Waiting& waiting : waiting_) {
            const std::size_t size = node_count(waiting.section->type);
            for (std::size_t first = 0; first < waiting.numbers.size(); first += size + 1) {
                for (std::size_t k = 0; k < size; ++k) {
                    const std::int64_t node = waiting.numbers[first + waiting.section->order[k]];
                    if (node < 1 || static_cast<std::uint64_t>(node) > grown_.mesh.points.size())
                        return unreadable("F007", {input_.name()},
                                          "vertex " + std::to_string(node) + " is not there: they run from 1 to " +
                                              std::to_string(grown_.mesh.points.size()));
                    nodes[k] = static_cast<std::uint32_t>(node - 1);
                }
                grown_.add(waiting.section->type, std::span(nodes).first(size),
                           grown_.entity(dimension(waiting.section->type), waiting.numbers[first + size], ""));
            }
        }
        return std::nullopt;
    }
};

}  // namespace

bool is_medit_binary(std::string_view head) {
    if (head.size() < 12) return false;
    const bool low = head.starts_with(lowest_first);
    if (!low && !head.starts_with(highest_first)) return false;
    // The version, then the section of the dimension.
    const auto number = [&](std::size_t at) {
        const std::string_view word = head.substr(at, 4);
        return low ? std::string{word[3], word[2], word[1], word[0]} : std::string(word);
    };
    const std::string version = number(4), section = number(8);
    return version.starts_with(std::string(3, '\0')) && version[3] >= 1 && version[3] <= 4 && section == std::string("\0\0\0\3", 4);
}

Result<Dataset> read_medit_binary(const Input& input, const ReadOptions& options) { return Reader(input, options).run(); }

}  // namespace geomend::meshes
