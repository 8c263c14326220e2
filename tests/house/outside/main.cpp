// SPDX-License-Identifier: AGPL-3.0-or-later
// Reads one file through the installed library and prints "format objects name..." or why it cannot be read.
#include <cstdio>

#include "formats/registry.h"
#include "model/dataset.h"
#include "topology/brep_from_dataset.h"

namespace {

int tell(const geomend::Failure& why) {
    std::fprintf(stderr, "%s %s\n", why.error.code.c_str(), why.error.message.c_str());
    return 3;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) return 2;
    const auto input = geomend::Input::open(arguments[1]);
    if (!input) return tell(input.why());
    const auto format = geomend::format_for_reading(*input);
    if (!format) return tell(format.why());
    const auto dataset = (*format)->read(*input, {});
    if (!dataset) return tell(dataset.why());
    std::printf("%s %zu\n", dataset->format.c_str(), dataset->objects.size());
    return 0;
}
