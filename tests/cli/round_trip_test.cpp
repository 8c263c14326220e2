// SPDX-License-Identifier: AGPL-3.0-or-later
// Each file through every format that can hold it and back: the same counts, names, roles, attributes, bounds.
#include <gtest/gtest.h>

#include "support/program.h"
#include "support/real_data.h"

namespace geomend::test {
namespace {

using Json = nlohmann::json;

struct Trip {
    const char* file;
    const char* through;  ///< name of the file between; its extension is the format
    const char* back;     ///< name of the file at the end
};

void PrintTo(const Trip& t, std::ostream* out) { *out << t.file << " -> " << t.through << " -> " << t.back; }

class RoundTrip : public testing::TestWithParam<Trip> {};

// What must be the same whatever the order of the objects.
Json essence(const Json& file) {
    std::vector<Json> objects;
    for (const Json& o : file["objects"]) {
        Json one{{"name", o["name"]}, {"kind", o["kind"]}, {"counts", o["counts"]}, {"role", o.value("role", "")}};
        for (const char* key : {"bounds", "dims", "units", "z_positive", "area", "volume", "attributes", "sets"}) {
            if (o.contains(key)) one[key] = o[key];
        }
        objects.push_back(std::move(one));
    }
    std::sort(objects.begin(), objects.end(), [](const Json& a, const Json& b) { return a.dump() < b.dump(); });
    return objects;
}

// Volumes are sums whose order may change.
void expect_same_brep(Json a, Json b) {
    ASSERT_EQ(a.is_object(), b.is_object());
    if (!a.is_object()) return;
    std::map<std::string, double> va, vb;
    for (const Json& r : a["region_volumes"]) va[r["name"]] += r.value("volume", 0.0);
    for (const Json& r : b["region_volumes"]) vb[r["name"]] += r.value("volume", 0.0);
    for (const auto& [name, v] : va) EXPECT_NEAR(vb[name], v, 1e-9 * std::abs(v)) << name;
    EXPECT_EQ(va.size(), vb.size());
    for (Json* j : {&a, &b}) {
        j->erase("region_volumes");
        j->erase("universe_volume");
    }
    EXPECT_EQ(a, b);
}

TEST_P(RoundTrip, GivesTheSameModel) {
    const Trip& trip = GetParam();
    const auto path = real_data(trip.file);
    if (!path) GTEST_SKIP() << trip.file << " is not here";
    const TemporaryFolder folder;
    const auto through = (folder / trip.through).string(), back = (folder / trip.back).string();
    const ProgramRun there = run_geomend({"convert", path->string(), "-o", through});
    ASSERT_EQ(there.status, 0) << there.err;
    const ProgramRun here = run_geomend({"convert", through, "-o", back});
    ASSERT_EQ(here.status, 0) << here.err;
    const Json a = info(*path), b = info(back);
    ASSERT_TRUE(a.is_object() && b.is_object());
    EXPECT_EQ(essence(a), essence(b));
    expect_same_brep(a.value("brep", Json()), b.value("brep", Json()));
}

INSTANTIATE_TEST_SUITE_P(Real, RoundTrip,
                         testing::Values(Trip{"gocad/modelA1.ml", "a.ml", "b.ml"}, Trip{"gocad/modelA1.ml", "a.vtm", "b.ml"},
                                         Trip{"gocad/modelA1.ml", "a.msh", "b.ml"}, Trip{"gocad/modelA4.ml", "a.ml.gz", "b.ml"},
                                         Trip{"gocad/modelA4.ml", "a.vtm", "b.ml"}, Trip{"gocad/split_cube.ml", "a.vtm", "b.ml"},
                                         Trip{"gocad/cube_model_equi.so", "a.so", "b.so"}, Trip{"gocad/test.lso", "a.lso", "b.lso"},
                                         Trip{"gocad/modelA4.so", "a.so", "b.so"}, Trip{"gocad/surf2d_multi.ts", "a.ts", "b.ts"},
                                         Trip{"gocad/surf2d_multi.ts", "a.vtm", "b.ts"}, Trip{"gocad/ts-2props.ts", "a.vtp", "b.ts"},
                                         Trip{"gocad/ts-2props.ts", "a.vtk", "b.ts"}, Trip{"gocad/normal_lines.pl", "a.vtp", "b.pl"},
                                         Trip{"gocad/points.vs", "a.vtp", "b.vs"}, Trip{"gocad/test.vo", "a.vo", "b.vo"},
                                         Trip{"gocad/test.vo", "a.vti", "b.vo"}, Trip{"gocad/test.wl", "a.wl", "b.wl"},
                                         Trip{"gmsh/toy_model.msh", "a.msh", "b.msh"}, Trip{"gmsh/cube_v22.msh", "a.so", "b.msh"},
                                         Trip{"gmsh/cube_v41.msh", "a.vtu", "b.msh"}, Trip{"vtk/box_hybrid_mesh.vtu", "a.vtk", "b.vtu"},
                                         Trip{"vtk/faultMesh.vtu", "a.vtk", "b.vtu"},
                                         Trip{"vtk/egg_withBurdens_small.vts", "a.vtk", "b.vts"},
                                         Trip{"vtk/dfn1_ascii.vtp", "a.vtk", "b.vtp"}, Trip{"vtk/supportedElements.vtk", "a.vtu", "b.vtk"},
                                         Trip{"vtk/cone_append_encoded.vtu", "a.msh", "b.vtu"}));

}  // namespace
}  // namespace geomend::test
