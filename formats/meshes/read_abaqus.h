// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>

#include "formats/format.h"

namespace geomend::meshes {

/// Whether a text begins as an input deck of Abaqus: a keyword behind a '*'.
int sniff_abaqus(std::string_view head, std::string_view base_name);

/// The mesh of an input deck of Abaqus or CalculiX: NODE; ELEMENT of solids (C3D...), shells and membranes (S, M3D, CPS, CPE ..., as
/// surfaces), beams and trusses (B, T3D); ELSET of an ELEMENT as its region, surface or line; NSET and further ELSETs as sets,
/// GENERATE and names of sets included; SURFACE of TYPE=ELEMENT as surfaces; INCLUDE. Nodes and elements of PARTs stand where each INSTANCE
/// puts them: a part with several is there as often, its regions called "INSTANCE.SET"; sets of a part hold those of all its instances.
/// Each keyword that says no mesh is listed as lost.
Result<Dataset> read_abaqus(const Input& input, const ReadOptions& options);

}  // namespace geomend::meshes
