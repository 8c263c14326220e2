// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/common.h"

#include <cmath>

namespace geomend::horizon {

Result<std::optional<ZPositive>> z_option(const FormatOptions& options) {
    const std::string_view word = option_value(options, "z");
    if (word.empty()) return std::optional<ZPositive>{};
    if (same_word(word, "depth")) return std::optional{ZPositive::depth};
    if (same_word(word, "elevation")) return std::optional{ZPositive::elevation};
    return failure(FailureKind::usage, "F018", {}, "option z: expected depth or elevation, found " + shown(word));
}

Dataset dataset_of(std::string variant, Object object) {
    Dataset dataset;
    dataset.format = "horizon";
    dataset.variant = std::move(variant);
    dataset.objects.push_back(std::move(object));
    return dataset;
}

Location NumberStream::here() const { return {input_->name(), cursor_.line(), cursor_.column()}; }

bool NumberStream::next(std::string_view what, double& value) {
    for (;;) {
        if (in_line_) {
            const std::string_view token = cursor_.token();
            if (!token.empty()) {
                if (auto failed = finite_number(*input_, cursor_, token, what, value)) {
                    failure_ = std::move(*failed);
                    return false;
                }
                return true;
            }
        }
        in_line_ = cursor_.next_line();
        if (!in_line_) {
            failure_ = unreadable("F004", here(), "expected " + std::string(what) + ", found the end of the file");
            return false;
        }
    }
}

bool NumberStream::fill(std::string_view what, const Monitor* monitor, std::vector<double>& values) {
    constexpr std::size_t often = std::size_t{1} << 16;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i % often == 0 && monitor != nullptr) {
            if (monitor->stopped()) {
                failure_ = stopped(*input_);
                return false;
            }
            monitor->progress("reading", static_cast<double>(i) / static_cast<double>(values.size()));
        }
        if (!next(what, values[i])) {
            if (failure_.error.code == "F004") {
                failure_.error.message = "expected " + std::to_string(values.size()) + " numbers (" + std::string(what) + "), found " +
                                         std::to_string(i) + " and the end of the file";
            }
            return false;
        }
    }
    return true;
}

bool NumberStream::at_end(std::string_view what) {
    do {
        if (in_line_ && !cursor_.at_line_end()) {
            const std::string_view token = cursor_.token();
            failure_ = unreadable("F008", location_of(*input_, cursor_, token),
                                  "expected the end of the file after " + std::string(what) + ", found " + shown(token));
            return false;
        }
        in_line_ = cursor_.next_line();
    } while (in_line_);
    return true;
}

}  // namespace geomend::horizon
