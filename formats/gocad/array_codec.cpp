// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/array_codec.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

namespace geomend::gocad {

namespace {

template <class Bits>
Bits from_big_endian(const char* at) {
    Bits bits;
    std::memcpy(&bits, at, sizeof bits);
    if constexpr (sizeof(Bits) == 2) bits = static_cast<Bits>(__builtin_bswap16(bits));
    else if constexpr (sizeof(Bits) == 4) bits = __builtin_bswap32(bits);
    else if constexpr (sizeof(Bits) == 8) bits = __builtin_bswap64(bits);
    return bits;
}
static_assert(std::endian::native == std::endian::little, "the byte order is turned on reading and writing");

template <class Bits>
void append_big_endian(std::string& out, Bits bits) {
    char bytes[sizeof(Bits)];
    for (std::size_t i = 0; i < sizeof(Bits); ++i) bytes[i] = static_cast<char>(bits >> (8 * (sizeof(Bits) - 1 - i)));
    out.append(bytes, sizeof bytes);
}

template <class Value, class Bits>
std::vector<Value> decode(std::string_view bytes, std::size_t count) {
    std::vector<Value> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = std::bit_cast<Value>(from_big_endian<Bits>(bytes.data() + i * sizeof(Bits)));
    return values;
}

// The value nearest to `v` that the type holds; NaN goes to 0 in integers.
template <class Value, class From>
Value nearest(From v) {
    if constexpr (std::is_floating_point_v<Value>) {
        return static_cast<Value>(v);
    } else if constexpr (std::is_floating_point_v<From>) {
        if (std::isnan(v)) return Value{0};
        const double rounded = std::nearbyint(static_cast<double>(v));
        if (rounded <= static_cast<double>(std::numeric_limits<Value>::min())) return std::numeric_limits<Value>::min();
        if (rounded >= static_cast<double>(std::numeric_limits<Value>::max())) return std::numeric_limits<Value>::max();
        return static_cast<Value>(rounded);
    } else {
        if (std::cmp_less(v, std::numeric_limits<Value>::min())) return std::numeric_limits<Value>::min();
        if (std::cmp_greater(v, std::numeric_limits<Value>::max())) return std::numeric_limits<Value>::max();
        return static_cast<Value>(v);
    }
}

template <class Value, class From>
bool fits(From v) {
    if constexpr (std::is_floating_point_v<From>) {
        if (std::isnan(v)) return std::is_floating_point_v<Value>;
        if constexpr (!std::is_floating_point_v<Value>) {
            if (v == From{0} && std::signbit(v)) return false;
        }
        return static_cast<From>(nearest<Value>(v)) == v;
    } else if constexpr (std::is_floating_point_v<Value>) {
        // Beyond 2^62 the way back through a 64-bit integer could overflow; such values go elsewhere.
        const double as_double = static_cast<double>(nearest<Value>(v));
        if (!(std::abs(as_double) < 4.6e18)) return false;
        return std::cmp_equal(static_cast<std::int64_t>(as_double), v);
    } else {
        return std::in_range<Value>(v);
    }
}

template <class Test>
bool all_fit(const AttributeValues& values, const Test& test) {
    return std::visit(
        [&](const auto& v) {
            using From = typename std::decay_t<decltype(v)>::value_type;
            if constexpr (std::is_arithmetic_v<From>) {
                for (const From x : v) {
                    if (!test(x)) return false;
                }
                return true;
            } else {
                return false;
            }
        },
        values);
}

template <class Value, class Bits>
void encode(const AttributeValues& values, std::string& out) {
    std::visit(
        [&](const auto& v) {
            using From = typename std::decay_t<decltype(v)>::value_type;
            if constexpr (std::is_arithmetic_v<From>) {
                out.reserve(out.size() + v.size() * sizeof(Bits));
                for (const From x : v) append_big_endian(out, std::bit_cast<Bits>(nearest<Value>(x)));
            } else {
                assert(false && "text has no binary form");
            }
        },
        values);
}

}  // namespace

std::size_t element_size(ArrayStorage storage) {
    switch (storage) {
        case ArrayStorage::float64:
            return 8;
        case ArrayStorage::int8:
        case ArrayStorage::uint8:
            return 1;
        case ArrayStorage::int16:
        case ArrayStorage::uint16:
            return 2;
        default:
            return 4;
    }
}

std::uint32_t element_components(ArrayStorage storage) { return storage == ArrayStorage::rgba ? 4 : 1; }

double ibm32_to_double(std::uint32_t bits) {
    const auto exponent = static_cast<int>((bits >> 24) & 0x7f) - 64;
    const double magnitude = std::ldexp(static_cast<double>(bits & 0xffffffu), 4 * exponent - 24);
    return (bits & 0x80000000u) != 0 ? -magnitude : magnitude;
}

std::uint32_t ibm32_from_double(double value) {
    const std::uint32_t sign = std::signbit(value) ? 0x80000000u : 0u;
    const double magnitude = std::abs(value);
    if (magnitude == 0 || std::isnan(value)) return sign;
    if (std::isinf(value)) return sign | 0x7fffffffu;
    int binary = 0;
    std::frexp(magnitude, &binary);
    int hex = binary > 0 ? (binary + 3) / 4 : -((-binary) / 4);  // smallest h with magnitude < 16^h
    double fraction = std::nearbyint(std::ldexp(magnitude, 24 - 4 * hex));
    if (fraction >= 16777216.0) {
        fraction /= 16;
        ++hex;
    }
    if (hex > 63) return sign | 0x7fffffffu;
    if (hex < -64) {
        fraction = std::nearbyint(std::ldexp(magnitude, 24 + 4 * 64));
        hex = -64;
    }
    return sign | (static_cast<std::uint32_t>(hex + 64) << 24) | static_cast<std::uint32_t>(fraction);
}

AttributeValues decode_array(std::string_view bytes, ArrayStorage storage, std::size_t count) {
    assert(bytes.size() / element_size(storage) >= count);
    switch (storage) {
        case ArrayStorage::float32:
            return decode<float, std::uint32_t>(bytes, count);
        case ArrayStorage::float64:
            return decode<double, std::uint64_t>(bytes, count);
        case ArrayStorage::ibm32:
            break;
        case ArrayStorage::int8:
            return decode<std::int8_t, std::uint8_t>(bytes, count);
        case ArrayStorage::uint8:
            return decode<std::uint8_t, std::uint8_t>(bytes, count);
        case ArrayStorage::int16:
            return decode<std::int16_t, std::uint16_t>(bytes, count);
        case ArrayStorage::uint16:
            return decode<std::uint16_t, std::uint16_t>(bytes, count);
        case ArrayStorage::int32:
            return decode<std::int32_t, std::uint32_t>(bytes, count);
        case ArrayStorage::uint32:
            return decode<std::uint32_t, std::uint32_t>(bytes, count);
        case ArrayStorage::rgba:
            return decode<std::uint8_t, std::uint8_t>(bytes, 4 * count);
    }
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = ibm32_to_double(from_big_endian<std::uint32_t>(bytes.data() + 4 * i));
    return values;
}

bool array_fits(const AttributeValues& values, ArrayStorage storage) {
    const auto test = [&]<class Value>(Value) { return all_fit(values, [](auto x) { return fits<Value>(x); }); };
    switch (storage) {
        case ArrayStorage::float32:
            return test(float{});
        case ArrayStorage::float64:
            return test(double{});
        case ArrayStorage::ibm32:
            return all_fit(values, [](auto x) {
                const auto back = ibm32_to_double(ibm32_from_double(static_cast<double>(x)));
                return fits<double>(x) && std::isfinite(back) && back == static_cast<double>(x) &&
                       std::signbit(back) == std::signbit(static_cast<double>(x));
            });
        case ArrayStorage::int8:
            return test(std::int8_t{});
        case ArrayStorage::rgba:
        case ArrayStorage::uint8:
            return test(std::uint8_t{});
        case ArrayStorage::int16:
            return test(std::int16_t{});
        case ArrayStorage::uint16:
            return test(std::uint16_t{});
        case ArrayStorage::int32:
            return test(std::int32_t{});
        case ArrayStorage::uint32:
            return test(std::uint32_t{});
    }
    return false;
}

void encode_array(const AttributeValues& values, ArrayStorage storage, std::string& out) {
    switch (storage) {
        case ArrayStorage::float32:
            return encode<float, std::uint32_t>(values, out);
        case ArrayStorage::float64:
            return encode<double, std::uint64_t>(values, out);
        case ArrayStorage::ibm32:
            break;
        case ArrayStorage::int8:
            return encode<std::int8_t, std::uint8_t>(values, out);
        case ArrayStorage::rgba:
        case ArrayStorage::uint8:
            return encode<std::uint8_t, std::uint8_t>(values, out);
        case ArrayStorage::int16:
            return encode<std::int16_t, std::uint16_t>(values, out);
        case ArrayStorage::uint16:
            return encode<std::uint16_t, std::uint16_t>(values, out);
        case ArrayStorage::int32:
            return encode<std::int32_t, std::uint32_t>(values, out);
        case ArrayStorage::uint32:
            return encode<std::uint32_t, std::uint32_t>(values, out);
    }
    std::visit(
        [&](const auto& v) {
            if constexpr (std::is_arithmetic_v<typename std::decay_t<decltype(v)>::value_type>) {
                for (const auto x : v) append_big_endian(out, ibm32_from_double(static_cast<double>(x)));
            }
        },
        values);
}

ArrayStorage storage_for(const AttributeValues& values) {
    using enum ArrayStorage;
    if (std::holds_alternative<std::vector<float>>(values)) return float32;
    if (std::holds_alternative<std::vector<std::int8_t>>(values)) return int8;
    if (std::holds_alternative<std::vector<std::uint8_t>>(values)) return uint8;
    if (std::holds_alternative<std::vector<std::int16_t>>(values)) return int16;
    if (std::holds_alternative<std::vector<std::uint16_t>>(values)) return uint16;
    if (std::holds_alternative<std::vector<std::int32_t>>(values)) return int32;
    if (std::holds_alternative<std::vector<std::uint32_t>>(values)) return uint32;
    if (std::holds_alternative<std::vector<double>>(values)) return array_fits(values, float32) ? float32 : float64;
    if (array_fits(values, int32)) return int32;
    if (array_fits(values, uint32)) return uint32;
    return float64;
}

}  // namespace geomend::gocad
