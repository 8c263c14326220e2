// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/finding.h"

namespace geomend {

/// Why an operation could not be done; each kind has its exit status in the command line.
enum class FailureKind : std::uint8_t {
    usage,        ///< a wrong option or argument (2)
    unreadable,   ///< an input cannot be read (3)
    unwritable,   ///< an output cannot be written (4)
    cannot_hold,  ///< the target format cannot hold the model (4)
    limit,        ///< a time or memory limit was hit (5)
    cancelled,    ///< stopped by the user (130)
    internal      ///< our own fault (70)
};

/// A diagnosed failure: `error` is what stopped us, `also` what else was found wrong before.
struct Failure {
    FailureKind kind = FailureKind::internal;
    Finding error;
    std::vector<Finding> also;
};

/// Makes a failure of one error-severity finding.
Failure failure(FailureKind kind, std::string code, Location where, std::string message);

/// Shorthand for FailureKind::unreadable.
Failure unreadable(std::string code, Location where, std::string message);

/// A value or the reason why there is none.
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Failure why) : state_(std::in_place_index<1>, std::move(why)) {}

    bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }

    /// \pre ok()
    T& value() & {
        assert(ok());
        return std::get<0>(state_);
    }
    const T& value() const& {
        assert(ok());
        return std::get<0>(state_);
    }
    T&& value() && {
        assert(ok());
        return std::get<0>(std::move(state_));
    }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

    /// \pre !ok()
    const Failure& why() const& {
        assert(!ok());
        return std::get<1>(state_);
    }
    Failure&& why() && {
        assert(!ok());
        return std::get<1>(std::move(state_));
    }

private:
    std::variant<T, Failure> state_;
};

/// The result of an operation that yields nothing but success.
template <>
class [[nodiscard]] Result<void> {
public:
    Result() = default;
    Result(Failure why) : failure_(std::move(why)) {}

    bool ok() const { return !failure_.has_value(); }
    explicit operator bool() const { return ok(); }
    const Failure& why() const& {
        assert(!ok());
        return *failure_;
    }
    Failure&& why() && {
        assert(!ok());
        return *std::move(failure_);
    }

private:
    std::optional<Failure> failure_;
};

}  // namespace geomend
