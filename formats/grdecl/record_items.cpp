// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "base/codes.h"
#include "base/number_text.h"
#include "formats/grdecl/deck.h"

namespace geomend::grdecl {

namespace {

Failure missing_item(const Scanner& in, const Record& record, std::string_view what) {
    return unreadable("F012", in.location(record.slash), "expected " + std::string(what) + ", found the end of the record");
}

}  // namespace

Finding finding(std::string code, Location where, std::string message, std::uint64_t count) {
    return make_finding(code, std::move(message), std::move(where), count);
}

Result<Record> take_record(Scanner& in, std::string_view keyword, std::vector<Finding>& findings) {
    const ItemCounts counts = item_counts(keyword);
    auto record = in.record(keyword, {counts.most, counts.words, counts.most > 0 ? is_known : nullptr, is_edit(keyword)});
    if (!record || !record->slash_missing) return record;
    if (std::ranges::find(findings, "F147", &Finding::code) == findings.end())
        findings.push_back(finding("F147", in.location(record->slash), "the record of " + std::string(keyword) + " has no '/' at its end"));
    return record;
}

OptionalFailure take_real(const Scanner& in, const Record& record, std::size_t i, std::string_view what, double& value) {
    if (!record.given(i)) return {};
    const NumberStatus status = record.items[i].quoted ? NumberStatus::malformed : parse_real(record.text(i), value);
    if (status == NumberStatus::ok && std::isfinite(value)) return {};
    const bool malformed = status == NumberStatus::malformed;
    return unreadable(malformed ? "F005" : "F006", in.location(record.items[i].at),
                      "expected " + std::string(what) + (malformed ? "" : " as a finite number") + ", found " + shown(record.text(i)));
}

OptionalFailure take_whole(const Scanner& in, const Record& record, std::size_t i, std::string_view what, std::int64_t& value) {
    if (!record.given(i)) return {};
    if (!record.items[i].quoted && parse_integer(record.text(i), value) == NumberStatus::ok) return {};
    return unreadable("F005", in.location(record.items[i].at),
                      "expected " + std::string(what) + " (a whole number), found " + shown(record.text(i)));
}

OptionalFailure need_real(const Scanner& in, const Record& record, std::size_t i, std::string_view what, double& value) {
    if (!record.given(i)) return missing_item(in, record, what);
    return take_real(in, record, i, what, value);
}

OptionalFailure need_whole(const Scanner& in, const Record& record, std::size_t i, std::string_view what, std::int64_t& value) {
    if (!record.given(i)) return missing_item(in, record, what);
    return take_whole(in, record, i, what, value);
}

OptionalFailure take_box(const Scanner& in, const Record& record, std::size_t i, const Dims& dims, CellBox& box) {
    constexpr std::array<std::string_view, 6> names = {"I1", "I2", "J1", "J2", "K1", "K2"};
    for (std::size_t n = 0; n < 6; ++n) {
        std::uint32_t& end = n % 2 == 0 ? box.first[n / 2] : box.last[n / 2];
        std::int64_t value = std::int64_t{end} + 1;
        if (auto failed = take_whole(in, record, i + n, names[n], value)) return failed;
        const std::uint32_t limit = dims[n / 2] == 0 ? 2'000'000'000 : dims[n / 2];
        if (value < 1 || value > limit) {
            const char* at = record.given(i + n) ? record.items[i + n].at : record.slash;
            return unreadable(
                "F012", in.location(at),
                "expected " + std::string(names[n]) + " from 1 to " + std::to_string(limit) + ", found " + std::to_string(value));
        }
        end = static_cast<std::uint32_t>(value - 1);
    }
    for (std::size_t a = 0; a < 3; ++a) {
        if (box.first[a] <= box.last[a]) continue;
        return unreadable("F012", in.location(record.begin),
                          "expected " + std::string(names[2 * a]) + " not beyond " + std::string(names[2 * a + 1]) + ", found " +
                              std::to_string(box.first[a] + 1) + " and " + std::to_string(box.last[a] + 1));
    }
    return {};
}

}  // namespace geomend::grdecl
