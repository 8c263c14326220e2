// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec3.h"

namespace geomend::repair {

/// A change of a model that the user asks for: what N. Euler calls an event (thesis, 5.2).
struct SurfaceEdit {
    enum Kind : std::uint8_t { remove, replace, move, add } kind = move;
    std::string surface;                 ///< the surface that it is about; of `add` empty, or the name that what comes in gets
    std::string face;                    ///< only this face of it, its name or its number in the file; empty: all
    std::string file;                    ///< of replace and add: where the new surface is read from; a recipe names it from its own folder
    Vec3 by{};                           ///< of move
    std::vector<std::uint32_t> objects;  ///< of the Dataset: what was read from the file
    bool operator==(const SurfaceEdit&) const = default;
};

/// "remove", "replace", "move" or "add".
std::string_view to_string(SurfaceEdit::Kind kind);

/// What edits wait for their turn, after N. Euler: the highest priority first, equal ones as they came; what an edit that is being done
/// asks for must not go before it.
class EditQueue {
public:
    struct Entry {
        SurfaceEdit edit;
        int priority = 0;
    };
    /// False where the same edit waits already or was done, or where its priority is above that of the one being done.
    bool push(SurfaceEdit edit, int priority);
    bool empty() const { return waiting_.empty(); }
    /// The next one, which is being done from then on. \pre not empty
    SurfaceEdit pop();

private:
    std::vector<Entry> waiting_, done_;
};

/// Removals come first, then what takes the place of something, moves, and what is added.
int priority_of(SurfaceEdit::Kind kind);

}  // namespace geomend::repair
