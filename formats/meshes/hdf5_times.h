// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace geomend::meshes {

/// Sets the times in the object headers of an HDF5 file to zero, and their checksums right, so that the same content is the same bytes at
/// any time. What is no header by its checksum stays. Headers of version 2, as libraries write that keep the order of links. Linear.
/// Source: The HDF Group, HDF5 File Format Specification 3.0, IV.A.1.b; the checksum is R. Jenkins' lookup3 (2006, public domain).
/// \return how many were set
std::size_t clear_hdf5_times(std::span<std::uint8_t> file);

/// R. Jenkins' lookup3 from 0.
std::uint32_t lookup3(std::span<const std::uint8_t> bytes);

}  // namespace geomend::meshes
