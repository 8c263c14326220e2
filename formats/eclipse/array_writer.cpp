// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/eclipse/array_writer.h"

#include <algorithm>
#include <mutex>
#include <vector>

#include "base/parallel.h"
#include "formats/eclipse/byte_order.h"

namespace geomend::eclipse {

namespace {

constexpr std::uint64_t numbers_per_record = 1000, texts_per_record = 105;
constexpr std::uint64_t records_at_once = 64;
constexpr std::uint64_t long_count = std::uint64_t{1} << 31;

void put_binary(char* p, std::int32_t value) { put_word(p, static_cast<std::uint32_t>(value)); }
void put_binary(char* p, float value) { put_word(p, std::bit_cast<std::uint32_t>(value)); }
void put_binary(char* p, double value) { put_long_word(p, std::bit_cast<std::uint64_t>(value)); }

template <class T>
struct Column;
template <>
struct Column<std::int32_t> {
    static constexpr std::string_view type = "INTE";
    static constexpr std::size_t width = 12, per_line = 6;
    static std::string text(std::int32_t value) { return std::to_string(value); }
};
template <>
struct Column<float> {
    static constexpr std::string_view type = "REAL";
    static constexpr std::size_t width = 17, per_line = 4;
    static std::string text(float value) { return fortran_real(value); }
};
template <>
struct Column<double> {
    static constexpr std::string_view type = "DOUB";
    static constexpr std::size_t width = 23, per_line = 3;
    static std::string text(double value) { return fortran_real(value); }
};

/// Puts columns on lines: a line ends when it is full, and after each record.
class Lines {
public:
    Lines(OutputFile& file, std::uint64_t count, std::size_t per_line, std::uint64_t per_record)
        : file_(file), count_(count), per_line_(per_line), per_record_(per_record) {}
    void add(std::string_view text, std::size_t width) {
        for (std::size_t i = text.size(); i < width; ++i) file_ << ' ';
        file_ << text;
        ++done_;
        ++on_line_;
        if (on_line_ != per_line_ && done_ % per_record_ != 0 && done_ != count_) return;
        file_ << '\n';
        on_line_ = 0;
    }

private:
    OutputFile& file_;
    std::uint64_t count_, done_ = 0;
    std::size_t per_line_, on_line_ = 0;
    std::uint64_t per_record_;
};

std::string padded(std::string_view text, std::size_t size) {
    std::string out(text.substr(0, size));
    out.resize(size, ' ');
    return out;
}

}  // namespace

void ArrayWriter::header(std::string_view name, std::uint64_t count, std::string_view type) {
    const auto one = [&](std::int64_t n, std::string_view word) {
        if (formatted_) {
            const std::string digits = std::to_string(n);
            file_ << " '" << padded(name, 8) << "' " << std::string(11 - std::min<std::size_t>(11, digits.size()), ' ') << digits << " '"
                  << word << "'\n";
            return;
        }
        char record[24];
        put_word(record, 16);
        std::copy_n(padded(name, 8).data(), 8, record + 4);
        put_word(record + 12, static_cast<std::uint32_t>(static_cast<std::int32_t>(n)));
        std::copy_n(word.data(), 4, record + 16);
        put_word(record + 20, 16);
        file_.write({record, sizeof record});
    };
    if (count >= long_count) one(-static_cast<std::int64_t>(count / long_count), "X231");
    one(static_cast<std::int64_t>(count % long_count), type);
}

/// get(first, values) fills a record's values; called from several threads.
template <class T, class Get>
void ArrayWriter::numbers(std::string_view name, std::uint64_t count, const Get& get) {
    header(name, count, Column<T>::type);
    const std::uint64_t records = (count + numbers_per_record - 1) / numbers_per_record;
    constexpr std::uint64_t stride = numbers_per_record * sizeof(T) + 8;
    Lines lines(file_, count, Column<T>::per_line, numbers_per_record);
    std::string bytes;
    std::vector<T> block;
    for (std::uint64_t r = 0; r < records && file_.good(); r += records_at_once) {
        const std::uint64_t some = std::min(records_at_once, records - r);
        if (formatted_) {
            for (std::uint64_t i = r; i != r + some; ++i) {
                const std::uint64_t first = i * numbers_per_record;
                block.resize(std::min(numbers_per_record, count - first));
                get(first, std::span<T>(block));
                for (const T value : block) lines.add(Column<T>::text(value), Column<T>::width);
            }
            continue;
        }
        const std::uint64_t values = std::min(some * numbers_per_record, count - r * numbers_per_record);
        bytes.resize(values * sizeof(T) + 8 * some);
        parallel_blocks(some, 16, [&](std::size_t from, std::size_t to) {
            std::vector<T> own(numbers_per_record);
            for (std::size_t i = from; i != to; ++i) {
                const std::uint64_t first = (r + i) * numbers_per_record, n = std::min(numbers_per_record, count - first);
                get(first, std::span<T>(own.data(), n));
                char* p = bytes.data() + i * stride;
                put_word(p, static_cast<std::uint32_t>(n * sizeof(T)));
                for (std::uint64_t v = 0; v != n; ++v) put_binary(p + 4 + v * sizeof(T), own[v]);
                put_word(p + 4 + n * sizeof(T), static_cast<std::uint32_t>(n * sizeof(T)));
            }
        });
        file_.write(bytes);
    }
}

void ArrayWriter::integers(std::string_view name, std::span<const std::int32_t> values) {
    numbers<std::int32_t>(name, values.size(), [&](std::uint64_t first, std::span<std::int32_t> to) {
        std::copy_n(values.data() + first, to.size(), to.data());
    });
}
void ArrayWriter::floats(std::string_view name, std::span<const float> values) {
    numbers<float>(name, values.size(),
                   [&](std::uint64_t first, std::span<float> to) { std::copy_n(values.data() + first, to.size(), to.data()); });
}
void ArrayWriter::doubles(std::string_view name, std::span<const double> values) {
    numbers<double>(name, values.size(),
                    [&](std::uint64_t first, std::span<double> to) { std::copy_n(values.data() + first, to.size(), to.data()); });
}
void ArrayWriter::integers_of_bytes(std::string_view name, std::span<const std::uint8_t> values) {
    numbers<std::int32_t>(name, values.size(), [&](std::uint64_t first, std::span<std::int32_t> to) {
        for (std::size_t i = 0; i != to.size(); ++i) to[i] = values[first + i];
    });
}

Rounding ArrayWriter::rounded(std::string_view name, std::uint64_t count, const Fill& fill) {
    Rounding all;
    std::mutex lock;
    numbers<float>(name, count, [&](std::uint64_t first, std::span<float> to) {
        double block[numbers_per_record];
        fill(first, {block, to.size()});
        Rounding own;
        for (std::size_t i = 0; i != to.size(); ++i) {
            to[i] = static_cast<float>(block[i]);
            const double shift =
                block[i] > static_cast<double>(to[i]) ? block[i] - static_cast<double>(to[i]) : static_cast<double>(to[i]) - block[i];
            own.changed += shift != 0;
            own.largest = std::max(own.largest, shift);
        }
        if (own.changed == 0) return;
        const std::lock_guard guard(lock);
        all.add(own);
    });
    return all;
}

Rounding ArrayWriter::rounded(std::string_view name, std::span<const double> values) {
    return rounded(name, values.size(),
                   [&](std::uint64_t first, std::span<double> to) { std::copy_n(values.data() + first, to.size(), to.data()); });
}

void ArrayWriter::logicals(std::string_view name, std::span<const std::uint8_t> values) {
    header(name, values.size(), "LOGI");
    if (formatted_) {
        Lines lines(file_, values.size(), 25, numbers_per_record);
        for (const std::uint8_t v : values) lines.add(v != 0 ? "T" : "F", 3);
        return;
    }
    for (std::uint64_t first = 0; first < values.size(); first += numbers_per_record) {
        const std::uint64_t n = std::min<std::uint64_t>(numbers_per_record, values.size() - first);
        std::string record(4 * n + 8, '\0');
        put_word(record.data(), static_cast<std::uint32_t>(4 * n));
        for (std::uint64_t i = 0; i != n; ++i) put_word(record.data() + 4 + 4 * i, values[first + i] != 0 ? 0xffffffffu : 0u);
        put_word(record.data() + 4 + 4 * n, static_cast<std::uint32_t>(4 * n));
        file_.write(record);
    }
}

void ArrayWriter::texts(std::string_view name, std::span<const std::string> values, std::size_t size) {
    std::string type = "CHAR";
    if (size != 8) {
        const std::string digits = std::to_string(size);
        type = "C" + std::string(3 - std::min<std::size_t>(3, digits.size()), '0') + digits;
    }
    header(name, values.size(), type);
    if (formatted_) {
        const std::size_t per_line = size == 8 ? 7 : std::max<std::size_t>(1, 80 / (size + 3));
        Lines lines(file_, values.size(), per_line, texts_per_record);
        for (const std::string& v : values) lines.add(" '" + padded(v, size) + "'", size + 3);
        return;
    }
    for (std::uint64_t first = 0; first < values.size(); first += texts_per_record) {
        const std::uint64_t n = std::min<std::uint64_t>(texts_per_record, values.size() - first);
        std::string record(size * n + 8, ' ');
        put_word(record.data(), static_cast<std::uint32_t>(size * n));
        for (std::uint64_t i = 0; i != n; ++i) std::copy_n(padded(values[first + i], size).data(), size, record.data() + 4 + i * size);
        put_word(record.data() + 4 + size * n, static_cast<std::uint32_t>(size * n));
        file_.write(record);
    }
}

void ArrayWriter::message(std::string_view name) { header(name, 0, "MESS"); }

}  // namespace geomend::eclipse
