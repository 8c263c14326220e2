// SPDX-License-Identifier: AGPL-3.0-or-later
// Reads, validates or repairs one file through the installed library and prints what came of it.
// usage: outside info|validate FILE, outside repair FILE OUTPUT
#include <cstdio>
#include <string_view>

#include "geomend/pipeline/load.h"
#include "geomend/pipeline/repair.h"
#include "geomend/pipeline/validate.h"
#include "geomend/topology/brep_from_dataset.h"

namespace {

int complain(const geomend::Failure& why) {
    std::fprintf(stderr, "%s %s\n", why.error.code.c_str(), why.error.message.c_str());
    return 3;
}

int info(const char* path) {
    auto dataset = geomend::load(path, {});
    if (!dataset) return complain(dataset.why());
    geomend::topology::build_breps(*dataset);
    std::printf("%s: %zu objects", dataset->format.c_str(), dataset->objects.size());
    for (const auto& brep : dataset->breps) std::printf(", %zu surfaces, %zu regions", brep->surfaces.size(), brep->regions.size());
    std::printf("\n");
    return 0;
}

int validate(const char* path) {
    const auto file = geomend::validate(path, geomend::LoadOptions{}, geomend::validators::CheckOptions{});
    if (!file) return complain(file.why());
    std::printf("%s\n", !file->valid ? "not judged" : *file->valid ? "valid" : "not valid");
    return 0;
}

int repair(const char* path, const char* output) {
    geomend::RepairRequest request;
    request.files.inputs = {path};
    request.files.output = output;
    const auto repaired = geomend::repair_file(request);
    if (!repaired) return complain(repaired.why());
    std::printf("%zu steps, %s\n", repaired->file.steps.size(), repaired->written ? "written" : "not written");
    return 0;
}

}  // namespace

int main(int count, char** arguments) {
    const std::string_view command = count > 1 ? arguments[1] : "";
    if (command == "info" && count == 3) return info(arguments[2]);
    if (command == "validate" && count == 3) return validate(arguments[2]);
    if (command == "repair" && count == 4) return repair(arguments[2], arguments[3]);
    return 2;
}
