// What the page shows: of each row the last picture that could be drawn and the one that was kept, and no other.
#pragma once

#include "studies/develop/drawing.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace shadowbench::develop {

/// May be used by several threads at once.
class LiveState {
public:
    /// `folder` and `command` are shown as they are.
    LiveState(std::string folder, std::string command) : folder_(std::move(folder)), command_(std::move(command)) {}

    /// A drawing has begun.
    void begin();

    /// It has ended. A row's first picture is kept at once.
    void finish(Drawing drawing);

    /// Keeps what is shown of each row that could be drawn.
    void keep();

    /// Nothing will change any more: all that wait return.
    void close();
    [[nodiscard]] bool isClosed() const;

    struct News {
        std::uint64_t version;
        std::string json; // on one line (studies/develop/page/develop.js shows it)
    };
    /// What is shown, as soon as it is another version than `seen`, of which the first is 1; nothing after `wait`.
    [[nodiscard]] std::optional<News> newsAfter(std::uint64_t seen, std::chrono::milliseconds wait) const;

    /// Of a number in the news; null for pictures that are not shown.
    [[nodiscard]] std::shared_ptr<const Pictures> pictures(std::uint64_t number) const;

private:
    struct Shown {
        std::uint64_t number = 0;
        std::vector<Figure> figures;
        std::shared_ptr<const Pictures> pictures;
    };
    struct Place {
        std::string scene, variant;
        std::string error; // of the last drawing
        std::optional<Shown> last, kept;
    };
    Place placeFor(Row row);
    [[nodiscard]] std::string json() const;
    void changed();

    mutable std::mutex mutex_;
    mutable std::condition_variable news_;
    std::string folder_, command_;
    std::vector<Place> places_;
    std::string error_;
    std::vector<std::string> warnings_;
    double seconds_ = 0;
    bool drawing_ = false, closed_ = false;
    std::uint64_t version_ = 1, numbers_ = 0;
};

} // namespace shadowbench::develop
