// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <unordered_map>

#include "model/brep.h"

namespace geomend::topology {

/// Puts each surface into the interface of a name, made where it is new; unknown roles give way to known ones.
class InterfaceBook {
public:
    explicit InterfaceBook(BrepData& brep) : brep_(brep) {}
    BrepData::Interface& enter(SurfaceId surface, const std::string& name);
    /// The interface of a name, or none.
    InterfaceId find(const std::string& name) const;

private:
    BrepData& brep_;
    std::unordered_map<std::string, InterfaceId> known_;
};

/// Names surfaces that have none: as their interface, with a number where it has several.
void name_surfaces(BrepData& brep);

/// Groups lines by the set of interfaces that they border.
void make_contacts(BrepData& brep);

/// Counts the lines inside regions (no region ends at any of their surfaces) and inside surfaces, once the
/// surfaces' regions are known.
void count_internal_lines(BrepData& brep);

}  // namespace geomend::topology
