// SPDX-License-Identifier: AGPL-3.0-or-later
#include <bit>
#include <cmath>
#include <cstring>

#include "formats/horizon/common.h"
#include "formats/horizon/irap_grid.h"
#include "formats/horizon/irap_header.h"

namespace geomend::horizon {

namespace {

constexpr double missing = static_cast<double>(1e30f);
constexpr float missing_above = 9.9e29f;
constexpr GridRules rules{"IRAP binary grids", true, true, missing, false};
constexpr std::uint32_t heights_per_record = 4096;

/// Position of the header's numbers in the file, behind the length of their record; the order differs from ASCII.
struct Field {
    std::size_t offset;
    std::size_t place;  // in IrapHeader
    bool integer;
};
constexpr std::array<Field, 12> fields = {{{4, 0, true},
                                           {8, 1, true},
                                           {12, 4, false},
                                           {16, 5, false},
                                           {20, 6, false},
                                           {24, 7, false},
                                           {28, 2, false},
                                           {32, 3, false},
                                           {44, 8, true},
                                           {48, 9, false},
                                           {52, 10, false},
                                           {56, 11, false}}};
struct RecordLength {
    std::size_t offset;
    std::uint32_t bytes;
};
constexpr std::array<RecordLength, 6> header_records = {{{0, 32}, {36, 32}, {40, 16}, {60, 16}, {64, 28}, {96, 28}}};
constexpr std::size_t header_size = 100;

std::uint32_t swapped(std::uint32_t v) { return v >> 24 | (v >> 8 & 0xff00u) | (v << 8 & 0xff0000u) | v << 24; }

std::uint32_t word_at(std::string_view bytes, std::size_t offset, bool big_endian) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return big_endian == (std::endian::native == std::endian::big) ? word : swapped(word);
}

void put_word(OutputFile& file, std::uint32_t word) {
    if constexpr (std::endian::native == std::endian::little) word = swapped(word);
    char bytes[sizeof word];
    std::memcpy(bytes, &word, sizeof word);
    file.write({bytes, sizeof bytes});
}
void put_float(OutputFile& file, double value) { put_word(file, std::bit_cast<std::uint32_t>(static_cast<float>(value))); }

Location at(const Input& input, std::size_t offset) { return {input.name(), 0, 0, static_cast<std::int64_t>(offset)}; }

Result<IrapHeader> read_header(const Input& input, bool big_endian) {
    const std::string_view bytes = input.bytes();
    if (bytes.size() < header_size) {
        return unreadable("F004", at(input, bytes.size()),
                          "expected an IRAP header of 100 bytes, found the end of the file after " + std::to_string(bytes.size()));
    }
    for (const RecordLength& record : header_records) {
        const std::uint32_t found = word_at(bytes, record.offset, big_endian);
        if (found != record.bytes) {
            return unreadable("F012", at(input, record.offset),
                              "expected the record length " + std::to_string(record.bytes) + ", found " + std::to_string(found));
        }
    }
    IrapHeader header{};
    for (const Field& field : fields) {
        const std::uint32_t word = word_at(bytes, field.offset, big_endian);
        header[field.place] =
            field.integer ? static_cast<double>(static_cast<std::int32_t>(word)) : static_cast<double>(std::bit_cast<float>(word));
        if (!std::isfinite(header[field.place]))
            return unreadable("F006", at(input, field.offset),
                              "expected a finite number in the header, found " + number_text(header[field.place]));
    }
    return header;
}

/// Appends the heights of one record and moves `offset` behind it.
std::optional<Failure> read_record(const Input& input, bool big_endian, std::size_t count, std::size_t& offset,
                                   std::vector<float>& heights) {
    const std::string_view bytes = input.bytes();
    if (bytes.size() - offset < 4) {
        return unreadable(
            "F004", at(input, offset),
            "expected " + std::to_string(count) + " heights, found " + std::to_string(heights.size()) + " and the end of the file");
    }
    const std::uint32_t length = word_at(bytes, offset, big_endian);
    if (length == 0 || length % 4 != 0 || length > 0x7fffffffu) {
        return unreadable("F012", at(input, offset),
                          "expected the length of a record of heights, found " + std::to_string(static_cast<std::int32_t>(length)));
    }
    if (length / 4 > count - heights.size()) {
        return unreadable("F008", at(input, offset),
                          "expected " + std::to_string(count) + " heights, found at least " + std::to_string(heights.size() + length / 4));
    }
    if (bytes.size() - offset < std::size_t{length} + 8) {
        return unreadable("F004", at(input, offset),
                          "expected a record of " + std::to_string(length) + " bytes, found the end of the file");
    }
    offset += 4;
    for (std::uint32_t i = 0; i < length / 4; ++i, offset += 4) {
        const float height = std::bit_cast<float>(word_at(bytes, offset, big_endian));
        if (!std::isfinite(height))
            return unreadable("F006", at(input, offset),
                              "expected a height as a finite number, found " + number_text(static_cast<double>(height)));
        heights.push_back(height > missing_above ? static_cast<float>(missing) : height);
    }
    if (word_at(bytes, offset, big_endian) != length) {
        return unreadable(
            "F012", at(input, offset),
            "expected the record length " + std::to_string(length) + " again, found " + std::to_string(word_at(bytes, offset, big_endian)));
    }
    offset += 4;
    return std::nullopt;
}

}  // namespace

int sniff_irap_grid_binary(std::string_view head, std::string_view) {
    if (head.starts_with(std::string_view("\0\0\0\x20\xff\xff\xfc\x1c", 8))) return 100;
    return head.starts_with(std::string_view("\x20\0\0\0\x1c\xfc\xff\xff", 8)) ? 100 : 0;
}

Result<Dataset> read_irap_grid_binary(const Input& input, const ReadOptions& options) {
    const auto sign = z_option(options.options);
    if (!sign) return sign.why();
    const std::string_view bytes = input.bytes();
    const bool big_endian = !bytes.starts_with('\x20');
    const auto header = read_header(input, big_endian);
    if (!header) return header.why();
    const auto stated = irap_frame(*header, (bytes.size() - header_size) / 4, at(input, 4));
    if (!stated) return stated.why();
    const std::size_t count = std::size_t{stated->frame.nx} * stated->frame.ny;
    std::vector<float> heights;
    heights.reserve(count);
    std::size_t offset = header_size;
    while (heights.size() < count) {
        if (options.monitor != nullptr && options.monitor->stopped()) return stopped(input);
        if (auto failed = read_record(input, big_endian, count, offset, heights)) return std::move(*failed);
    }
    if (offset != bytes.size()) {
        return unreadable("F008", at(input, offset),
                          "expected the end of the file after " + std::to_string(count) + " heights, found " +
                              std::to_string(bytes.size() - offset) + " bytes more");
    }
    Raster raster = make_horizon(stated->frame, std::move(heights), missing, sign->value_or(ZPositive::elevation), sign->has_value());
    raster.info.name = name_of(input);
    raster.info.precision = CoordinatePrecision::single_precision;
    Dataset dataset = dataset_of("IRAP classic grid binary", std::move(raster));
    if (!stated->warning.empty()) dataset.findings.push_back(irap_warning(stated->warning, at(input, 4)));
    return dataset;
}

Result<std::vector<Loss>> write_irap_grid_binary(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    std::vector<Loss> losses;
    const auto grid = grid_for_writing(dataset, rules, out, options, losses);
    if (!grid) return grid.why();

    OutputFile& file = out.main_file();
    const IrapHeader header = irap_header(*grid);
    std::array<std::uint32_t, header_size / 4> words{};
    for (const RecordLength& record : header_records) words[record.offset / 4] = record.bytes;
    for (const Field& field : fields) {
        const double number = header[field.place];
        words[field.offset / 4] = field.integer ? static_cast<std::uint32_t>(static_cast<std::int32_t>(number))
                                                : std::bit_cast<std::uint32_t>(static_cast<float>(number));
    }
    for (const std::uint32_t word : words) put_word(file, word);
    for (std::size_t first = 0; first < grid->heights.size(); first += heights_per_record) {
        const std::size_t count = std::min<std::size_t>(heights_per_record, grid->heights.size() - first);
        put_word(file, static_cast<std::uint32_t>(4 * count));
        for (std::size_t i = 0; i < count; ++i) put_float(file, grid->heights[first + i]);
        put_word(file, static_cast<std::uint32_t>(4 * count));
    }
    return losses;
}

}  // namespace geomend::horizon
