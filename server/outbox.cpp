// SPDX-License-Identifier: Apache-2.0
#include "outbox.hpp"

#include <iterator>
#include <utility>

namespace semview::server {

Outbox::Outbox(Send send, std::uint64_t max_bytes, std::size_t max_replies_per_client)
    : send_(std::move(send)),
      max_bytes_(max_bytes),
      max_replies_per_client_(max_replies_per_client) {}

void Outbox::deliver(Outgoing reply) {
  const auto found = waiting_.find(reply.client);
  if (found == waiting_.end()) {
    const Sent sent = send_(reply);
    if (sent == Sent::kGone) ++undelivered_;
    if (sent != Sent::kFull) return;
  }
  const std::size_t ahead = found == waiting_.end() ? 0 : found->second.size();
  if (ahead >= max_replies_per_client_ || bytes_ + reply.bytes() > max_bytes_) {
    ++undelivered_;
    return;
  }
  bytes_ += reply.bytes();
  Replies& replies = waiting_[reply.client];
  replies.push_back(std::move(reply));
}

void Outbox::flush() {
  for (auto entry = waiting_.begin(); entry != waiting_.end();) {
    entry = send_some(entry->second) ? waiting_.erase(entry) : std::next(entry);
  }
}

std::size_t Outbox::waiting(const std::string& client) const {
  const auto found = waiting_.find(client);
  return found == waiting_.end() ? 0 : found->second.size();
}

bool Outbox::send_some(Replies& replies) {
  while (!replies.empty()) {
    const Sent sent = send_(replies.front());
    if (sent == Sent::kFull) return false;
    if (sent == Sent::kGone) ++undelivered_;
    drop_front(replies);
  }
  return true;
}

void Outbox::drop_front(Replies& replies) {
  bytes_ -= replies.front().bytes();
  replies.pop_front();
}

}  // namespace semview::server
