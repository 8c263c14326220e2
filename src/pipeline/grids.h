// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "base/result.h"
#include "formats/format.h"
#include "grid/boundary_model.h"
#include "model/dataset.h"

// What a conversion does to corner-point grids before they are written.

namespace geomend {

/// Grids that came without geometry (property files) give what they hold to the grid with the same dimensions. Failure
/// F007 where there is none.
Result<void> join_properties(Dataset& dataset);

/// Options map=apply (grid::apply_map_axes) and connections=compute: all pairs of cells that touch without being
/// neighbours become connections of the grid and, where it has PERMX, they and TRANX, TRANY, TRANZ get
/// transmissibilities; pairs below 1e-6 are left out then, as simulators do, and told. quality=add gives each cell
/// figures of its shape (grid::quality_attributes). Failure (usage) for other values.
/// Decks get no computed connections (F155): what reads COORD and ZCORN finds them itself, and would have them twice. For the
/// same reason those are taken away that a simulator's own file lists with their transmissibilities.
Result<void> apply_grid_options(Dataset& dataset, const Format& target, const FormatOptions& options);

/// Whether a dataset holds a grid whose numbers of cells are not stated, so that those of another input may be them.
bool has_guessed_dims(const Dataset& dataset);

/// Numbers of cells of the first grid with geometry, as the option dims takes them; empty: there is none.
std::string dims_option_of(const Dataset& dataset);

/// For targets that hold corner-point grids: structured grids and cells with attributes I, J, K become such grids where
/// columns allow it. With `like`, the attributes of every mesh go onto its first grid instead, which takes the place of
/// the meshes. Failure (cannot_hold) names the first cell that does not fit.
Result<void> make_grids(Dataset& dataset, const Format& target, const Dataset* like);

/// Turns corner-point grids into meshes of cells where the target cannot hold them: plain cells, or with
/// faces=conformal polyhedra that fit face to face; with regions=NAME cells are grouped by an attribute. With as=brep, and
/// for targets that hold surfaces of a model only, they become a boundary representation (grid::boundary_model) with the
/// regions of regions=NAME and horizons below the layers of horizons=N,M,... What the target cannot say of a grid is
/// added to dataset.losses.
Result<void> shape_grids(Dataset& dataset, const Format& target, const FormatOptions& options);

/// What options regions=NAME and horizons=N,M,... ask of a boundary representation. Failure (usage): not numbers.
Result<grid::ModelRequest> model_request(const FormatOptions& options);

}  // namespace geomend
