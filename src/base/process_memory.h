// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

namespace geomend {

/// The most memory that the process has had since it began, or since forget_peak_memory(), in bytes; 0 where the system does not say.
double peak_memory();
/// Counts the peak from now on, where the system allows it.
void forget_peak_memory();

}  // namespace geomend
