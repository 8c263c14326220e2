// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/codes.h"
#include "base/finding.h"
#include "model/loss.h"

namespace geomend {

/// Something of a file that a reader does not put into the Dataset.
struct Dropped {
    LossClass loss_class = LossClass::substance;
    std::string entity = {};  ///< whose; empty: of the whole file
    std::string what = {};    ///< "record 'X'"
    std::string why = {};     ///< "it is not a record of this format"
    std::uint64_t count = 1;
    Location where = {};
    std::string_view code = "F150";  ///< of the finding
    std::string message = {};        ///< of the finding; empty: made of `what` and `why`
};

/// Lists what is dropped as a loss, without a finding of its own: for readers that have reported it already.
inline void list_dropped(std::vector<Loss>& losses, const Dropped& d) {
    add_loss(losses, {d.loss_class, d.entity, d.what, d.why, std::max<std::uint64_t>(1, d.count)});
}

/// The one door through which readers leave something out: it stands in the list of losses (so that `convert` asks for
/// --lossy where it is substance), and, unless it is a matter of style, among the findings with its place. The severity is
/// that of the code's row. The same thing is counted, not repeated.
inline void drop(std::vector<Finding>& findings, std::vector<Loss>& losses, Dropped d) {
    list_dropped(losses, d);
    if (d.loss_class == LossClass::style) return;
    std::string message = d.message.empty() ? d.what + (d.what.empty() ? "" : " is not read: ") + d.why : std::move(d.message);
    const auto same = std::ranges::find_if(findings, [&](const Finding& f) { return f.code == d.code && f.message == message; });
    if (same != findings.end()) {
        same->count += d.count;
        return;
    }
    Finding f = make_finding(d.code, std::move(message), std::move(d.where), d.count);
    if (!d.entity.empty()) f.entities.push_back({"part", d.entity});
    findings.push_back(std::move(f));
}

}  // namespace geomend
