// How technique folders end whose technique.toml or shader was changed at random: taken and drawn, or refused in one line
// that begins with their own path, or, of a loop without an end, ended after a limit. Ends with 1 where one ends otherwise
// or a file is left.
//     build/release/benchmarks/fuzzed_folders benchmarks/fuzzed-folder --runs 10000
#include "base/error.h"
#include "base/files.h"
#include "base/one_line.h"
#include "base/parallel.h"
#include "base/temporary_folder.h"
#include "base/worker_processes.h"
#include "harness/render/stage.h"
#include "scene/load/load.h"
#include "techniques/folder/folder_technique.h"
#include "techniques/gl/context.h"
#include "tests/fuzz/tokens.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

/// Of a worker.
struct Bench {
    std::unique_ptr<gl::Context> context = gl::Context::create();
    Scene scene = loadScene("simple", Profile::Gate);
    std::optional<Stage> stage;

    Bench() {
        scene.size = {32, 32};
        stage.emplace(scene);
        stage->show(0);
    }
};

void draw(Bench& bench, const fs::path& folder) {
    const techniques::Entry entry = techniques::folderEntry(techniques::readTechniqueFolder(folder));
    for (const std::string& variant : entry.variants) {
        const auto technique = entry.make(techniques::parseParameters(variant, entry.parameters, entry.id));
        for (int frame = 0; frame < 2; ++frame) bench.stage->render(*technique, frame, 1);
        (void)bench.stage->visibility();
    }
}

class Fuzzing {
public:
    Fuzzing(const fs::path& folder, std::size_t runs) : runs_(runs) {
        for (const fs::directory_entry& file : fs::directory_iterator(folder))
            texts_.emplace_back(file.path().filename().string(), readFile(file.path()));
        std::ranges::sort(texts_);
    }

    bool all() {
        std::unique_ptr<Bench> bench; // of a worker
        SharedWork work;
        work.items = runs_;
        work.work = [&](std::size_t run, const Progress&) -> std::string {
            const fs::path folder = write(run);
            try {
                if (!bench) bench = std::make_unique<Bench>();
                draw(*bench, folder);
                fs::remove_all(folder);
                return "";
            } catch (const std::exception& error) {
                fs::remove_all(folder);
                return error.what();
            }
        };
        work.leave = [&] { bench.reset(); };
        work.finished = [&](std::size_t run, const std::string& answer) { count(run, answer); };
        work.lost = [&](std::size_t run, const std::string& how) {
            fs::remove_all(place(run));
            count(run, how.starts_with("failed: ") ? how.substr(8) : how);
        };
        work.limit = [](std::size_t) { return std::chrono::seconds(20); };
        shareAmongProcesses(availableThreads(), work);
        const bool left = !fs::is_empty(room_.path());
        fmt::print("{} folders: {} taken and drawn, {} refused in one line, {} ended after their limit, {} otherwise; {}\n",
                   runs_, taken_, refused_, late_, wrong_, left ? "files are left" : "no file is left");
        return wrong_ == 0 && !left;
    }

private:
    [[nodiscard]] fs::path place(std::size_t run) const { return room_.path() / std::to_string(run); }

    /// Each of the files in turn is the one that is changed.
    [[nodiscard]] fs::path write(std::size_t run) const {
        fs::create_directory(place(run));
        for (std::size_t i = 0; i < texts_.size(); ++i) {
            const auto& [name, text] = texts_[i];
            std::FILE* file = std::fopen((place(run) / name).c_str(), "w"); // not flushed to the disk, as writeFile would
            const std::string written = i == run % texts_.size() ? fuzz::changed(text, run) : text;
            std::fwrite(written.data(), 1, written.size(), file);
            std::fclose(file);
        }
        return place(run);
    }

    void count(std::size_t run, const std::string& said) {
        const bool isOneLine = said.starts_with(place(run).string()) && onOneLine(said) == said;
        const bool isLate = said.ends_with("was ended");
        ++(said.empty() ? taken_ : isOneLine ? refused_ : isLate ? late_ : wrong_);
        if (!said.empty() && !isOneLine) fmt::print("{}: run {}: {}\n", texts_[run % texts_.size()].first, run, said);
    }

    std::size_t runs_, taken_ = 0, refused_ = 0, late_ = 0, wrong_ = 0;
    std::vector<std::pair<std::string, std::string>> texts_;
    TemporaryFolder room_;
};

} // namespace
} // namespace shadowbench

int main(int argc, char** argv) {
    CLI::App app("Technique folders that were changed at random.");
    std::filesystem::path folder;
    std::size_t runs = 10'000;
    app.add_option("folder", folder, "What is changed")->required();
    app.add_option("--runs", runs, "How many")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    return shadowbench::Fuzzing(folder, runs).all() ? 0 : 1;
}
