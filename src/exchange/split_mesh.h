// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "model/loss.h"
#include "model/volume_mesh.h"

namespace geomend::exchange {

/// Doubles the vertices of some surfaces, so that cells on both sides no longer hang together there. Cells around a vertex stay together
/// where one gets from one to the other through faces that are not on these surfaces: around a free border nothing is doubled, and what
/// one surface does there does not keep another one from opening. Of k parts around a vertex one keeps it and k - 1 get a new one, behind
/// all others. Faces that were one become pairs; sets, places and attributes go along: a set of nodes has all that were made of one, a set
/// of edges one edge each. \param split one per surface of the mesh, not 0 where it is to be split Failure (cannot_hold) where cells have
/// nodes between their corners. Cost: n log n. Source: A. Botella, Génération de maillages non structurés volumiques de modèles géologiques
/// pour la simulation de phénomènes physiques (2016), 4.4.4, with parts around a vertex in place of its test of both sides.
Result<VolumeMesh> split_along(const VolumeMesh& mesh, std::span<const std::uint8_t> split);

/// Which surfaces of a mesh have the role of a fault.
std::vector<std::uint8_t> faults_of(const VolumeMesh& mesh);

/// Makes one again of vertices that were doubled. Values of the first one are kept; others are listed where they differ.
/// Failure (cannot_hold) where three cells would have one face. Cost: n log n.
Result<VolumeMesh> joined(const VolumeMesh& mesh, std::vector<Loss>& losses);

}  // namespace geomend::exchange
