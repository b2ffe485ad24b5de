#include "base/live_files.h"

#include <array>
#include <atomic>
#include <climits>
#include <cstring>
#include <unistd.h>

namespace shadowbench {
namespace {

enum class State : int { Free, Changing, Live };

struct Place {
    std::atomic<State> state = State::Free;
    std::array<char, PATH_MAX> path{};
};
static_assert(std::atomic<State>::is_always_lock_free); // as a signal handler needs

std::array<Place, 32> places; // with room for the threads of most machines

} // namespace

LiveFile::LiveFile(const std::string& path) : place_(0) {
    if (path.size() >= PATH_MAX) place_ = places.size();
    for (State free = State::Free; place_ < places.size(); ++place_, free = State::Free) {
        Place& place = places[place_];
        if (!place.state.compare_exchange_strong(free, State::Changing)) continue;
        std::memcpy(place.path.data(), path.c_str(), path.size() + 1);
        place.state = State::Live;
        return;
    }
}

LiveFile::~LiveFile() {
    if (place_ < places.size()) places[place_].state = State::Free;
}

void removeLiveFiles() {
    for (const Place& place : places)
        if (place.state == State::Live) ::unlink(place.path.data());
}

} // namespace shadowbench
