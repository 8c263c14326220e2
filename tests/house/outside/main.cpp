// SPDX-License-Identifier: AGPL-3.0-or-later
// Reads one file through the installed library and prints what it holds, or why it cannot be read.
#include <cstdio>

#include "pipeline/load.h"
#include "topology/brep_from_dataset.h"

int main(int count, char** arguments) {
    if (count != 2) return 2;
    auto dataset = geomend::load(arguments[1], {});
    if (!dataset) {
        std::fprintf(stderr, "%s %s\n", dataset.why().error.code.c_str(), dataset.why().error.message.c_str());
        return 3;
    }
    geomend::topology::build_breps(*dataset);
    std::printf("%s: %zu objects", dataset->format.c_str(), dataset->objects.size());
    for (const auto& brep : dataset->breps) std::printf(", %zu surfaces, %zu regions", brep->surfaces.size(), brep->regions.size());
    std::printf("\n");
    return 0;
}
