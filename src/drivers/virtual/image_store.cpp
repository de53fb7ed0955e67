#include "drivers/virtual/image_store.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "core/error.hpp"

namespace credo {
namespace {

constexpr std::size_t kLeastHeld = 8;
/// Images behind the newest position that a slower stream may still ask for.
constexpr std::int64_t kBehind = 3;

std::size_t capacity_of(SensorDataset const& dataset, std::size_t budget_mb) {
  std::size_t const bytes = static_cast<std::size_t>(dataset.width()) *
                            static_cast<std::size_t>(dataset.height()) *
                            (sizeof(std::uint16_t) + sizeof(Rgb));
  return std::max(kLeastHeld, (budget_mb << 20U) / bytes);
}

}  // namespace

ImageStore::ImageStore(SensorDataset const& dataset, std::size_t budget_mb, Order order,
                       std::function<void(std::string const&)> complain)
    : dataset_(dataset),
      capacity_(capacity_of(dataset, budget_mb)),
      order_(std::move(order)),
      complain_(std::move(complain)),
      thread_([this](std::stop_token const& stop) { decode_ahead(stop); }) {}

void ImageStore::wait_until_ahead() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return ahead_; });
}

std::size_t ImageStore::held() const {
  std::scoped_lock const lock(mutex_);
  return images_.size();
}

SensorImagesPtr ImageStore::at(std::int64_t position, std::stop_token const& stop) {
  std::optional<std::size_t> const image = order_(position);
  if (!image) {
    return nullptr;
  }
  std::unique_lock lock(mutex_);
  if (position > newest_) {
    newest_ = position;
    ahead_ = false;
    changed_.notify_all();
  }
  auto found = images_.find(*image);
  // One that has been forgotten (it is far behind the newest) does not come back.
  changed_.wait(lock, stop, [&] {
    found = images_.find(*image);
    return found != images_.end() || ahead_;
  });
  return found != images_.end() ? found->second : nullptr;
}

void ImageStore::decode_ahead(std::stop_token const& stop) {
  while (!stop.stop_requested()) {
    std::unique_lock lock(mutex_);
    forget_what_passed();
    std::optional<std::size_t> const image = next_missing();
    if (!image) {
      ahead_ = true;
      changed_.notify_all();
      changed_.wait(lock, stop, [this] { return !ahead_; });
      continue;
    }
    lock.unlock();
    SensorImagesPtr decoded;
    try {
      decoded = std::make_shared<SensorImages const>(dataset_.read(*image));
    } catch (InputError const& error) {
      complain_(error.what());
    }
    lock.lock();
    images_[*image] = std::move(decoded);
    changed_.notify_all();
  }
}

std::int64_t ImageStore::end() const {
  // From the start, so many positions show each image there is.
  return newest_ + (dataset_.count() <= capacity_ ? static_cast<std::int64_t>(dataset_.count())
                                                  : static_cast<std::int64_t>(capacity_) - kBehind);
}

std::optional<std::size_t> ImageStore::next_missing() const {
  if (images_.size() == dataset_.count()) {
    return std::nullopt;
  }
  for (std::int64_t position = newest_; position < end(); ++position) {
    std::optional<std::size_t> const image = order_(position);
    if (image && !images_.contains(*image)) {
      return image;
    }
  }
  return std::nullopt;
}

void ImageStore::forget_what_passed() {
  if (dataset_.count() <= capacity_) {
    return;
  }
  std::set<std::size_t> needed;
  for (std::int64_t position = std::max<std::int64_t>(newest_ - kBehind, 0); position < end();
       ++position) {
    if (std::optional<std::size_t> const image = order_(position)) {
      needed.insert(*image);
    }
  }
  std::erase_if(images_, [&](auto const& held) { return !needed.contains(held.first); });
}

}  // namespace credo
