// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "base/output.h"
#include "base/parallel.h"

namespace geomend::gmsh {

/// Grows as needed; numbers are put straight into it.
class TextPiece {
public:
    void clear() { used_ = 0; }
    std::string_view view() const { return {bytes_.get(), used_}; }

    /// Makes room for `n` more bytes; each put below needs at most 32.
    void need(std::size_t n) {
        if (used_ + n > size_) grow(n);
    }
    void put(char c) { bytes_[used_++] = c; }
    void put(std::string_view text) {
        need(text.size());
        std::memcpy(bytes_.get() + used_, text.data(), text.size());
        used_ += text.size();
    }
    template <class Number>
    void number(Number value) {
        if constexpr (std::is_floating_point_v<Number>) {
            if (std::isnan(value)) {  // without a sign
                put(std::string_view("nan"));
                return;
            }
        }
        const auto end = std::to_chars(bytes_.get() + used_, bytes_.get() + size_, value).ptr;
        used_ = static_cast<std::size_t>(end - bytes_.get());
    }
    template <class Number>
    void raw(Number value) {
        std::memcpy(bytes_.get() + used_, &value, sizeof value);
        used_ += sizeof value;
    }

private:
    void grow(std::size_t n) {
        const std::size_t size = std::max(2 * size_, used_ + n + 4096);
        std::unique_ptr<char[]> bytes(new char[size + slack]);  // what compilers cannot see that it is never used
        if (used_ > 0) std::memcpy(bytes.get(), bytes_.get(), used_);
        bytes_ = std::move(bytes);
        size_ = size;
    }
    static constexpr std::size_t slack = 64;
    std::unique_ptr<char[]> bytes_;
    std::size_t size_ = 0;
    std::size_t used_ = 0;
};

/// Calls format(first, last, piece) on ranges that cover 0..count, several at the same time, and writes the pieces in
/// order. The text does not depend on how the ranges are cut as long as format treats each number by itself.
template <class Format>
void write_pieces(OutputFile& out, std::size_t count, std::size_t grain, const Format& format) {
    constexpr std::size_t at_once = 16;
    std::vector<TextPiece> pieces(std::min(at_once, (count + grain - 1) / grain));
    for (std::size_t base = 0; base < count && out.good(); base += at_once * grain) {
        const std::size_t n = std::min(at_once, (count - base + grain - 1) / grain);
        parallel_for_each_index(n, [&](std::size_t i) {
            const std::size_t first = base + i * grain;
            pieces[i].clear();
            format(first, std::min(count, first + grain), pieces[i]);
        });
        for (std::size_t i = 0; i < n; ++i) out.write(pieces[i].view());
    }
}

}  // namespace geomend::gmsh
