// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/hdf5_times.h"

#include <algorithm>
#include <array>
#include <bit>

namespace geomend::meshes {

namespace {

std::uint32_t word_at(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t count = 4) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < count; ++i) word |= std::uint32_t{bytes[at + i]} << 8 * i;
    return word;
}

}  // namespace

std::uint32_t lookup3(std::span<const std::uint8_t> bytes) {
    std::uint32_t a = 0xdeadbeefU + static_cast<std::uint32_t>(bytes.size()), b = a, c = a;
    const auto turn = [](std::uint32_t x, int bits) { return std::rotl(x, bits); };
    std::size_t at = 0;
    for (; bytes.size() - at > 12; at += 12) {
        a += word_at(bytes, at);
        b += word_at(bytes, at + 4);
        c += word_at(bytes, at + 8);
        a -= c, a ^= turn(c, 4), c += b;
        b -= a, b ^= turn(a, 6), a += c;
        c -= b, c ^= turn(b, 8), b += a;
        a -= c, a ^= turn(c, 16), c += b;
        b -= a, b ^= turn(a, 19), a += c;
        c -= b, c ^= turn(b, 4), b += a;
    }
    const std::size_t left = bytes.size() - at;
    if (left == 0) return c;
    a += word_at(bytes, at, std::min<std::size_t>(left, 4));
    if (left > 4) b += word_at(bytes, at + 4, std::min<std::size_t>(left - 4, 4));
    if (left > 8) c += word_at(bytes, at + 8, left - 8);
    c ^= b, c -= turn(b, 14);
    a ^= c, a -= turn(c, 11);
    b ^= a, b -= turn(a, 25);
    c ^= b, c -= turn(b, 16);
    a ^= c, a -= turn(c, 4);
    b ^= a, b -= turn(a, 14);
    c ^= b, c -= turn(b, 24);
    return c;
}

namespace {

using Bytes = std::span<std::uint8_t>;

/// Clears what stands behind the end of the text of an attribute of one text of fixed length, which writers leave as it was in memory.
void clear_behind_text(Bytes attribute) {
    constexpr std::size_t head = 9;
    if (attribute.size() < head || attribute[0] != 3 || attribute[1] != 0) return;
    const std::size_t name = word_at(attribute, 2, 2), type = word_at(attribute, 4, 2), space = word_at(attribute, 6, 2);
    const std::size_t at = head + name + type + space;
    if (type < 8 || space < 2 || attribute.size() < at) return;
    constexpr std::uint8_t text_class = 3;
    const bool is_one_text = (attribute[head + name] & 0x0f) == text_class && attribute[head + name + type + 1] == 0;
    const std::size_t length = word_at(attribute, head + name + 4);
    if (!is_one_text || attribute.size() - at < length) return;
    const Bytes text = attribute.subspan(at, length);
    std::fill(std::find(text.begin(), text.end(), std::uint8_t{0}), text.end(), std::uint8_t{0});
}

/// The messages of a part of a header, and of the parts in which it goes on. \param checked where the checksum begins
void clear_part(Bytes file, Bytes part, std::size_t messages, std::size_t checked, bool has_order, int depth) {
    constexpr std::uint8_t attribute = 0x0c, further = 0x10;
    constexpr int most_parts = 1000;
    const std::size_t head = has_order ? 6 : 4;
    for (std::size_t at = messages; at + head <= checked;) {
        const std::size_t size = word_at(part, at + 1, 2), begin = at + head;
        if (begin + size > checked) break;
        const Bytes message = part.subspan(begin, size);
        if (part[at] == attribute) clear_behind_text(message);
        if (part[at] == further && size >= 16 && depth < most_parts && word_at(message, 4) == 0 && word_at(message, 12) == 0) {
            const std::size_t place = word_at(message, 0), length = word_at(message, 8);
            if (place <= file.size() && length <= file.size() - place && length >= 8 &&
                lookup3(file.subspan(place, length - 4)) == word_at(file, place + length - 4))
                clear_part(file, file.subspan(place, length), 4, length - 4, has_order, depth + 1);
        }
        at = begin + size;
    }
    const std::uint32_t sum = lookup3(part.first(checked));
    for (std::size_t i = 0; i < 4; ++i) part[checked + i] = static_cast<std::uint8_t>(sum >> 8 * i);
}

}  // namespace

std::size_t clear_hdf5_times(std::span<std::uint8_t> file) {
    constexpr std::array<std::uint8_t, 5> signature{'O', 'H', 'D', 'R', 2};
    constexpr std::uint8_t has_times = 0x20, has_attribute_limits = 0x10, has_order = 0x04, size_of_size = 0x03;
    constexpr std::size_t times = 16;
    std::size_t cleared = 0;
    for (auto begin = file.begin();;) {
        begin = std::search(begin, file.end(), signature.begin(), signature.end());
        if (begin == file.end()) return cleared;
        const std::span<std::uint8_t> header(begin, file.end());
        ++begin;
        if (header.size() < 6 + times || (header[5] & has_times) == 0) continue;
        const std::size_t size_at = 6 + times + ((header[5] & has_attribute_limits) != 0 ? 4 : 0);
        const std::size_t size_bytes = std::size_t{1} << (header[5] & size_of_size);
        if (size_bytes > 4 || header.size() < size_at + size_bytes) continue;
        const std::size_t end = size_at + size_bytes + word_at(header, size_at, size_bytes);
        if (header.size() < end + 4 || lookup3(header.first(end)) != word_at(header, end)) continue;
        std::ranges::fill(header.subspan(6, times), std::uint8_t{0});
        clear_part(file, header, size_at + size_bytes, end, (header[5] & has_order) != 0, 0);
        ++cleared;
    }
}

}  // namespace geomend::meshes
