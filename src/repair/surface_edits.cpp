// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/surface_edits.h"

#include <algorithm>

namespace geomend::repair {

std::string_view to_string(SurfaceEdit::Kind kind) {
    switch (kind) {
        case SurfaceEdit::remove:
            return "remove";
        case SurfaceEdit::replace:
            return "replace";
        case SurfaceEdit::move:
            return "move";
        case SurfaceEdit::add:
            return "add";
    }
    return "";
}

int priority_of(SurfaceEdit::Kind kind) { return 4 - static_cast<int>(kind); }

bool EditQueue::push(SurfaceEdit edit, int priority) {
    const auto is_same = [&](const Entry& e) { return e.edit == edit; };
    if (std::ranges::any_of(waiting_, is_same) || std::ranges::any_of(done_, is_same)) return false;
    if (!done_.empty() && priority > done_.back().priority) return false;
    const auto after = std::ranges::find_if(waiting_, [&](const Entry& e) { return e.priority < priority; });
    waiting_.insert(after, {std::move(edit), priority});
    return true;
}

SurfaceEdit EditQueue::pop() {
    done_.push_back(std::move(waiting_.front()));
    waiting_.erase(waiting_.begin());
    return done_.back().edit;
}

}  // namespace geomend::repair
