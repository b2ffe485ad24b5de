#include "studies/develop/develop.h"

#include "base/error.h"
#include "base/interrupts.h"
#include "base/temporary_folder.h"
#include "harness/cells/cell_selection.h"
#include "studies/develop/folder_watch.h"
#include "studies/develop/live_state.h"
#include "studies/develop/page_server.h"

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace shadowbench::develop {
namespace {

/// Those that are files.
std::vector<std::filesystem::path> filesOf(const std::vector<std::string>& scenes) {
    std::vector<std::filesystem::path> files;
    for (const std::string& scene : scenes)
        if (std::filesystem::path(scene).is_absolute()) files.emplace_back(scene);
    return files;
}

/// Has what drawing asks of the scenes: their truths, and how long it may take.
void prepare(Request& request) {
    const std::vector<Scene> scenes = chosenScenes(request.scenes, request.profile);
    computeTruths(scenes, request.cache);
    request.limit = limitFor(scenes);
}

/// What cannot be drawn for a reason outside of the folder is shown, too: a full disk may be emptied.
void drawInto(LiveState& state, FolderWatch& watch, FolderWatch& scenes, Request& request,
              const std::filesystem::path& room) {
    watch.settle(DeferredInterrupts::pending);
    state.begin();
    try {
        if (scenes.changed()) {
            scenes.settle(DeferredInterrupts::pending);
            prepare(request);
        }
        if (auto drawing = draw(request, room, [&] { return watch.changed(); })) state.finish(std::move(*drawing));
    } catch (const Error& error) {
        if (!DeferredInterrupts::pending()) state.finish({{}, error.what(), {}, 0});
    }
}

} // namespace

void develop(Request request, const std::string& command, const std::function<void(int)>& ready) {
    const std::vector<std::filesystem::path> files = filesOf(request.scenes);
    FolderWatch scenes("", files);
    scenes.settle(DeferredInterrupts::pending);
    limitRows();
    prepare(request);
    const TemporaryFolder room; // an interrupt waits until it is gone
    LiveState state(request.folder.filename().string(), command);
    const PageServer server(state);
    ready(server.port());
    FolderWatch watch(request.folder, files);
    while (!DeferredInterrupts::pending()) {
        constexpr std::chrono::milliseconds tick{50};
        if (watch.changed())
            drawInto(state, watch, scenes, request, room.path());
        else
            std::this_thread::sleep_for(tick);
    }
}

} // namespace shadowbench::develop
