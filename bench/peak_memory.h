// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <string>

#include "base/input.h"
#include "model/dataset.h"

// Memory at the peak of one reading, measured in a process that does nothing else: what an allocator keeps of earlier work
// would hide some of it.

namespace geomend::bench {

/// A line of /proc/self/status in bytes, e.g. "VmHWM:".
inline double status_bytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    std::string word;
    double value = 0;
    while (status >> word) {
        if (word == key && status >> value) return 1024 * value;
    }
    return 0;
}

/// Bytes of the arrays that a reading leaves behind.
inline double array_bytes(const Dataset& dataset) {
    std::size_t bytes = 0;
    const auto add = [&](const auto& array) { bytes += array.size() * sizeof(array[0]); };
    for (const Object& object : dataset.objects) {
        for (const Attribute& a : info_of(object).attributes) std::visit(add, a.values);
        if (const auto* s = std::get_if<Surface>(&object)) {
            add(s->points);
            add(s->polygons.corners);
            add(s->polygons.offsets);
            add(s->labels.ids);
            add(s->alias);
        } else if (const auto* m = std::get_if<CellMesh>(&object)) {
            add(m->points);
            add(m->types);
            add(m->offsets);
            add(m->nodes);
            add(m->cell_entity);
            add(m->point_labels.ids);
            add(m->cell_labels.ids);
            add(m->facet_tags);
            add(m->alias);
        }
    }
    return static_cast<double>(bytes);
}

/// In a process of its own (main with "--peak FILE"): reads once and prints what that added at its peak. The mapped file is
/// touched before, so that its pages are no part of the figure.
template <class Read>
int print_peak(const char* path, const Read& read) {
    const auto input = Input::open(path);
    if (!input) return 1;
    unsigned char sum = 0;
    for (std::size_t i = 0; i < input->bytes().size(); i += 4096) sum = static_cast<unsigned char>(sum + input->bytes()[i]);
    benchmark::DoNotOptimize(sum);
    const double before = status_bytes("VmRSS:");
    const auto dataset = read(*input);
    if (!dataset) return 1;
    std::printf("%.0f\n", status_bytes("VmHWM:") - before);
    return 0;
}

/// Starts this program anew with "--peak FILE" and gives its figure in bytes; -1 where that fails.
inline double peak_of_reading(const std::string& path) {
    std::array<char, 4096> self{};
    if (::readlink("/proc/self/exe", self.data(), self.size() - 1) <= 0) return -1;
    const std::string command = "'" + std::string(self.data()) + "' --peak '" + path + "'";
    FILE* child = ::popen(command.c_str(), "r");
    if (child == nullptr) return -1;
    double bytes = -1;
    const bool told = std::fscanf(child, "%lf", &bytes) == 1;
    return ::pclose(child) == 0 && told ? bytes : -1;
}

/// Puts both figures beside a benchmark of reading.
inline void report_memory(benchmark::State& state, const std::string& path, const Dataset& dataset) {
    state.counters["peak_MB"] = peak_of_reading(path) / 1e6;
    state.counters["array_MB"] = array_bytes(dataset) / 1e6;
}

}  // namespace geomend::bench
