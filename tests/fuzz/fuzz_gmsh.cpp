// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstdint>
#include <string>

#include "formats/gmsh/gmsh.h"

// What can be read must be writable and readable again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace geomend;
    const Format& msh = gmsh::formats()[0];
    const std::string content(reinterpret_cast<const char*>(data), size);
    msh.sniff(content, "fuzz.msh");
    const auto dataset = msh.read(Input::from_memory(content, "fuzz.msh"), {});
    if (!dataset) {
        if (dataset.why().error.code.empty()) __builtin_trap();
        return 0;
    }
    OutputSet outputs("geomend-fuzz.msh");  // never committed: the temporary file goes again
    WriteOptions options;
    options.options = {{"version", size % 2 == 0 ? "2.2" : "4.1"}, {"binary", size % 3 == 0 ? "yes" : "no"}};
    const auto losses = msh.write(*dataset, outputs, options);
    if (!losses && losses.why().error.code.empty()) __builtin_trap();
    return 0;
}
