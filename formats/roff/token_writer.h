// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/output.h"

namespace geomend::roff {

/// Where the bytes of a file, or of a text in memory, go.
class Sink {
public:
    explicit Sink(OutputFile& file) : file_(&file) {}
    explicit Sink(std::string& text) : text_(&text) {}
    void write(std::string_view bytes) {
        if (file_ != nullptr) {
            file_->write(bytes);
        } else {
            text_->append(bytes);
        }
    }

private:
    OutputFile* file_ = nullptr;
    std::string* text_ = nullptr;
};

/// Writes tags, values and arrays in either form. Binary numbers are little-endian, as RMS writes them.
class TokenWriter {
public:
    TokenWriter(Sink sink, bool text) : sink_(sink), text_(text) {}

    /// "roff-bin" or "roff-asc", and a comment.
    void start();
    void comment(std::string_view words);
    void begin_tag(std::string_view name);
    void end_tag();

    void value(std::string_view name, std::int32_t v);
    void value(std::string_view name, float v);
    void value(std::string_view name, double v);
    void value(std::string_view name, std::string_view v);
    /// A byte, or a bool.
    void value(std::string_view name, std::uint8_t v, bool boolean);

    void array(std::string_view name, std::span<const std::int32_t> values);
    void array(std::string_view name, std::span<const float> values);
    void array(std::string_view name, std::span<const double> values);
    void array(std::string_view name, std::span<const std::string> values);
    void array(std::string_view name, std::span<const std::uint8_t> values, bool boolean);

    /// An array of floats in pieces: first how many there are, then the pieces.
    void begin_floats(std::string_view name, std::uint64_t count);
    void more_floats(std::span<const float> values);
    void end_floats();

private:
    void word(std::string_view text);
    void head(bool array, std::string_view type, std::string_view name, std::uint64_t count);
    void quoted(std::string_view text);
    template <class T>
    void numbers(std::span<const T> values);
    template <class T>
    void one(T value);

    Sink sink_;
    bool text_;
    std::size_t column_ = 0;
    std::string line_;
};

}  // namespace geomend::roff
