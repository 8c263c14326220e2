// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <sstream>

#include "base/number_text.h"
#include "pipeline/repair.h"
#include "support/program.h"
#include "support/real_data.h"
#include "support/seeds.h"

// Models of files are damaged at random in their triangles and points, and repaired from file to file: what is written has no error,
// where one is left nothing is written, and no failure is our own. GEOMEND_SEEDS says how many; GEOMEND_FIRST_SEED, from which on.

namespace geomend {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> healthy_files() {
    std::vector<fs::path> files;
    for (const char* name : {"layered_box.ml", "layered_box_gap.ml", "layered_box_loose.ts", "crossing_sheets.ts", "open_layers.ts"})
        files.push_back(fs::path(GEOMEND_SOURCE_DIR) / "samples" / name);
    for (const char* name : {"gocad/modelA1.ml", "gocad/split_cube.ml", "gocad/not_sealed_cube.ml", "gocad/surf2d_multi.ts",
                             "gocad/tsurf_eks.ts", "gocad/auscope/tsTest.ts"}) {
        if (const auto real = test::real_data(name)) files.push_back(*real);
    }
    return files;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

bool is_point(const std::string& line) { return line.starts_with("VRTX ") || line.starts_with("PVRTX "); }
bool is_triangle(const std::string& line) { return line.starts_with("TRGL "); }

/// The words of a line.
std::vector<std::string> words_of(const std::string& line) {
    std::istringstream stream(line);
    return {std::istream_iterator<std::string>(stream), {}};
}

std::string joined(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
    return line;
}

/// The largest extent of all points.
double size_of(const std::vector<std::string>& lines) {
    double low = 1e300, high = -1e300;
    for (const std::string& line : lines) {
        const auto words = words_of(line);
        double x = 0;
        if (!is_point(line) || words.size() < 5 || parse_real(words[2], x) != NumberStatus::ok) continue;
        low = std::min(low, x);
        high = std::max(high, x);
    }
    return high > low ? high - low : 1;
}

class Damage {
public:
    Damage(std::vector<std::string> lines, unsigned seed) : lines_(std::move(lines)), engine_(seed), size_(size_of(lines_)) {
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (is_point(lines_[i])) points_.push_back(i);
            if (is_triangle(lines_[i])) triangles_.push_back(i);
        }
    }

    std::string done() {
        for (std::size_t n = 1 + engine_() % 6; n > 0 && !triangles_.empty() && !points_.empty(); --n) one();
        std::string text;
        for (const std::string& line : lines_) {
            if (!line.empty()) text += line + '\n';
        }
        return text;
    }

private:
    std::size_t any(const std::vector<std::size_t>& places) { return places[engine_() % places.size()]; }
    double random() { return static_cast<double>(engine_()) / 2147483648.0 - 1; }

    void move_point(std::size_t line, double by) {
        auto words = words_of(lines_[line]);
        if (words.size() < 5) return;
        for (std::size_t k = 2; k < 5; ++k) {
            double x = 0;
            if (parse_real(words[k], x) == NumberStatus::ok) words[k] = number_text(x + by * random());
        }
        lines_[line] = joined(words);
    }

    void one() {
        constexpr double shares[] = {1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 0.1};
        const std::size_t t = any(triangles_);
        switch (engine_() % 8) {
            case 0:  // a hole
                lines_[t].clear();
                break;
            case 1: {  // a wide hole
                const std::size_t first = engine_() % triangles_.size();
                for (std::size_t i = first; i < std::min(first + 1 + engine_() % 20, triangles_.size()); ++i) lines_[triangles_[i]].clear();
                break;
            }
            case 2:  // a double
                lines_[t] += '\n' + lines_[t];
                break;
            case 3: {  // one wound the other way
                auto words = words_of(lines_[t]);
                if (words.size() >= 4) std::swap(words[1], words[2]);
                lines_[t] = joined(words);
                break;
            }
            case 4: {  // corners of another one
                auto words = words_of(lines_[t]);
                const auto others = words_of(lines_[any(triangles_)]);
                if (words.size() >= 4 && others.size() >= 4) words[1 + engine_() % 3] = others[1 + engine_() % 3];
                lines_[t] = joined(words);
                break;
            }
            case 5: {  // points shaken
                const double by = size_ * shares[engine_() % 6];
                for (const std::size_t p : points_) {
                    if (engine_() % 10 == 0) move_point(p, by);
                }
                break;
            }
            case 6: {  // one point on another one
                const auto to = words_of(lines_[any(points_)]);
                auto words = words_of(lines_[any(points_)]);
                const std::size_t p = any(points_);
                words = words_of(lines_[p]);
                if (words.size() >= 5 && to.size() >= 5) std::copy(to.begin() + 2, to.begin() + 5, words.begin() + 2);
                lines_[p] = joined(words);
                break;
            }
            default:
                move_point(any(points_), size_ * shares[engine_() % 6]);
        }
    }

    std::vector<std::string> lines_;
    std::mt19937 engine_;
    double size_;
    std::vector<std::size_t> points_, triangles_;
};

struct Tally {
    unsigned written = 0, left = 0, unreadable = 0;
};

void repair_damaged(const fs::path& file, unsigned seed, const test::TemporaryFolder& folder, Tally& tally) {
    const std::string in = folder / ("in" + file.extension().string()), out = folder / "out.ml";
    const std::string text = Damage(lines_of(test::read_file(file.string())), seed).done();
    test::write_file(in, text);
    fs::remove(out);
    const std::string where = file.filename().string() + ", seed " + std::to_string(seed);
    RepairRequest request;
    request.files.inputs = {in};
    request.files.output = out;
    request.files.lossy = true;
    if (seed % 3 == 0) request.recipe.max_gap = 0.01 * static_cast<double>(seed % 100);
    const auto repaired = repair_file(request);
    EXPECT_EQ(test::read_file(in), text) << where;
    if (!repaired) {
        EXPECT_NE(repaired.why().kind, FailureKind::internal) << where << ": " << repaired.why().error.message;
        EXPECT_FALSE(fs::exists(out)) << where;
        ++tally.unreadable;
        return;
    }
    ASSERT_EQ(fs::exists(out), repaired->written) << where;
    tally.written += repaired->written ? 1u : 0u;
    tally.left += repaired->written ? 0u : 1u;
    if (!repaired->written) return;
    const auto again = validate(out, LoadOptions{}, validators::CheckOptions{});
    ASSERT_TRUE(again) << where;
    for (const Finding& f : again->findings) EXPECT_NE(f.severity, Severity::error) << where << ": " << f.code << " " << f.message;
}

TEST(DamagedFiles, AreMendedWithoutAnErrorOrNotWritten) {
    const auto files = healthy_files();
    const test::TemporaryFolder folder;
    const unsigned first = test::first_seed(0);
    Tally tally;
    for (unsigned seed = first; seed < first + test::seeds(30); ++seed) repair_damaged(files[seed % files.size()], seed, folder, tally);
    std::printf("written %u, left %u, not read %u\n", tally.written, tally.left, tally.unreadable);
    EXPECT_GT(tally.written, 0u);
}

}  // namespace
}  // namespace geomend
