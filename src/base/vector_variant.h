// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>
#include <variant>

namespace geomend {

/// One of several kinds of vectors: a std::variant that may be copied where memory is short. The standard library of GCC 12 takes a
/// variant of vectors for one that always has a value; where a copy fails it destroys one that was never made, and crashes.
template <class... Vectors>
class VectorVariant : public std::variant<Vectors...> {
    using Base = std::variant<Vectors...>;

public:
    using Base::Base;
    VectorVariant() = default;
    VectorVariant(VectorVariant&&) noexcept = default;
    VectorVariant& operator=(VectorVariant&&) noexcept = default;
    ~VectorVariant() = default;

    VectorVariant(const VectorVariant& other) : Base() {
        std::visit([this]<class Vector>(const Vector& values) { *this = Vector(values); }, static_cast<const Base&>(other));
    }
    VectorVariant& operator=(const VectorVariant& other) {
        if (this != &other) *this = VectorVariant(other);
        return *this;
    }
    template <class Vector>
    requires(std::same_as<std::remove_cvref_t<Vector>, Vectors> || ...) VectorVariant& operator=(Vector&& values) {
        Base::operator=(std::forward<Vector>(values));
        return *this;
    }
};

}  // namespace geomend
