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

// A tetrahedron of two surfaces; the properties of the first share a name.
const char* model_with_equal_names() {
    return "GOCAD Model3d 1\nHEADER {\nname:m\n}\nTSURF cap\nTSURF floor\n"
           "TFACE 1 boundary cap\n0 0 1\n1 0 0\n0 1 0\nTFACE 2 boundary floor\n0 0 0\n1 0 0\n0 1 0\n"
           "REGION 3 Universe\n-1 +2 0\nREGION 4 inside\n+1 -2 0\nEND\n"
           "GOCAD TSurf 1\nHEADER {\nname:cap\n}\nPROPERTIES p p\nUNITS m ft\nTFACE\n"
           "PVRTX 1 0 0 1 1 10\nPVRTX 2 1 0 0 2 20\nPVRTX 3 0 1 0 3 30\nPVRTX 4 0 0 0 4 40\n"
           "TRGL 1 2 3\nTRGL 1 3 4\nTRGL 1 4 2\nEND\n"
           "GOCAD TSurf 1\nHEADER {\nname:floor\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";
}

TEST(ModelRoundTrip, PropertiesOfOneNameComeBackApart) {
    const TemporaryFolder folder;
    write_file(folder / "m.ml", model_with_equal_names());
    for (const char* through : {"m.vtm", "m.msh"}) {
        const ProgramRun there = run_geomend({"convert", (folder / "m.ml").string(), "-o", (folder / through).string()});
        ASSERT_EQ(there.status, 0) << there.err;
        const ProgramRun back = run_geomend({"convert", (folder / through).string(), "-o", (folder / "back.ml").string()});
        ASSERT_EQ(back.status, 0) << back.err;
        const std::string text = read_file(folder / "back.ml");
        EXPECT_NE(text.find("PROPERTIES p p\n"), std::string::npos) << through << '\n' << text;
        EXPECT_NE(text.find("UNITS m ft\n"), std::string::npos) << through;
        for (const char* values : {"0 0 1 1 10", "1 0 0 2 20", "0 1 0 3 30", "0 0 0 4 40"}) {
            EXPECT_NE(text.find(values), std::string::npos) << through << ' ' << values;
        }
    }
}

}  // namespace
}  // namespace geomend::test
