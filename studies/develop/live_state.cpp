#include "studies/develop/live_state.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace shadowbench::develop {
namespace {

using Json = nlohmann::ordered_json;

Json figuresOf(const std::vector<Figure>& now, const std::vector<Figure>* kept) {
    Json figures = Json::array();
    for (const Figure& figure : now) {
        Json json{{"name", figure.name}, {"share", figure.isShare}, {"now", figure.value}, {"kept", nullptr}};
        if (kept != nullptr)
            if (const auto same = std::ranges::find(*kept, figure.name, &Figure::name); same != kept->end())
                json["kept"] = same->value;
        figures.push_back(std::move(json));
    }
    return figures;
}

} // namespace

void LiveState::changed() {
    ++version_;
    news_.notify_all();
}

void LiveState::begin() {
    const std::scoped_lock lock(mutex_);
    drawing_ = true;
    changed();
}

LiveState::Place LiveState::placeFor(Row row) {
    const auto before = std::ranges::find_if(
        places_, [&](const Place& place) { return place.scene == row.scene && place.variant == row.variant; });
    Place place = before != places_.end() ? std::move(*before) : Place{row.scene, row.variant, "", {}, {}};
    place.error = std::move(row.error);
    if (!place.error.empty()) return place;
    place.last = Shown{++numbers_, std::move(row.figures), std::move(row.pictures)};
    if (!place.kept) place.kept = place.last;
    return place;
}

void LiveState::finish(Drawing drawing) {
    const std::scoped_lock lock(mutex_);
    drawing_ = false;
    error_ = std::move(drawing.error);
    warnings_ = std::move(drawing.warnings);
    seconds_ = drawing.seconds;
    if (error_.empty()) { // else the rows stay, for what is wrong may be set right soon
        std::vector<Place> places;
        for (Row& row : drawing.rows) places.push_back(placeFor(std::move(row)));
        places_ = std::move(places);
    }
    changed();
}

void LiveState::keep() {
    const std::scoped_lock lock(mutex_);
    for (Place& place : places_)
        if (place.error.empty() && place.last) place.kept = place.last;
    changed();
}

void LiveState::close() {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
    news_.notify_all();
}

bool LiveState::isClosed() const {
    const std::scoped_lock lock(mutex_);
    return closed_;
}

std::optional<LiveState::News> LiveState::newsAfter(std::uint64_t seen, std::chrono::milliseconds wait) const {
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, wait, [&] { return closed_ || version_ != seen; });
    if (closed_ || version_ == seen) return std::nullopt;
    return News{version_, json()};
}

std::shared_ptr<const Pictures> LiveState::pictures(std::uint64_t number) const {
    const std::scoped_lock lock(mutex_);
    for (const Place& place : places_)
        for (const std::optional<Shown>* shown : {&place.last, &place.kept})
            if (*shown && (*shown)->number == number) return (*shown)->pictures;
    return nullptr;
}

std::string LiveState::json() const {
    Json rows = Json::array();
    for (const Place& place : places_) {
        Json row{{"scene", place.scene}, {"variant", place.variant}, {"error", place.error}};
        row["last"] = place.last ? Json(place.last->number) : Json(nullptr);
        row["kept"] = place.kept ? Json(place.kept->number) : Json(nullptr);
        row["figures"] =
            place.last ? figuresOf(place.last->figures, place.kept ? &place.kept->figures : nullptr) : Json::array();
        rows.push_back(std::move(row));
    }
    const Json all{{"folder", folder_}, {"command", command_},   {"drawing", drawing_}, {"seconds", seconds_},
                   {"error", error_},   {"warnings", warnings_}, {"rows", rows}};
    return all.dump(-1, ' ', false, Json::error_handler_t::replace); // a compiler may quote any byte of a shader
}

} // namespace shadowbench::develop
