// SPDX-License-Identifier: MIT
// Six Crazyflies that fly examples/08_crazyflie.cpp, a process each, as far as the app can tell: a body with inertia, a
// radio that reaches all, loses every tenth packet and cuts some short. Says at the end where they are.
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <deque>
#include <string_view>
#include <vector>

#include "crazyflie_firmware.h"

namespace {

constexpr int robots = 6;
constexpr TickType_t flight_ms = 60'000;
constexpr float lag_s = 0.2F, range_m = 2.0F;
constexpr useconds_t wall_us_per_step = 3000;  // for 0.1 s of the robots'

struct Place {
  float x = 0.0F, y = 0.0F;
};
float between(Place a, Place b) { return std::hypot(a.x - b.x, a.y - b.y); }

// The app's calls carry nothing that could hold this.
// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables)
std::array<std::array<int, 2>, robots> radio{}, report{};  // of each robot: where it receives, where others send
int self = 0;
TickType_t now_ms = 0;
Place place, velocity;
float yaw_deg = 0.0F;
setpoint_t wanted{};
void (*heard)(P2PPacket*) = nullptr;
std::deque<std::vector<std::uint8_t>> queue;
std::size_t queue_length = 0, item_bytes = 0;
unsigned dice = 1;
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

unsigned throw_dice() { return (dice = dice * 1664525U + 1013904223U) >> 16U; }

void move(float seconds) {
  const float turn = yaw_deg * 3.14159265F / 180.0F, share = std::min(1.0F, seconds / lag_s);
  const float c = std::cos(turn), s = std::sin(turn), forward = wanted.velocity.x, left = wanted.velocity.y;
  velocity.x += share * (c * forward - s * left - velocity.x);
  velocity.y += share * (s * forward + c * left - velocity.y);
  place.x += seconds * velocity.x;
  place.y += seconds * velocity.y;
}

bool is_in_one_piece(const std::array<Place, robots>& places) {
  std::vector<int> reached{0};
  for (std::size_t next = 0; next < reached.size(); ++next)
    for (int j = 0; j < robots; ++j)
      if (std::find(reached.begin(), reached.end(), j) == reached.end() &&
          between(places[static_cast<std::size_t>(reached[next])], places[static_cast<std::size_t>(j)]) <= range_m)
        reached.push_back(j);
  return reached.size() == robots;
}

}  // namespace

extern "C" {

void p2pRegisterCB(void (*callback)(P2PPacket*)) { heard = callback; }
bool radiolinkSendP2PPacketBroadcast(P2PPacket* packet) {
  for (int i = 0; i < robots; ++i) {
    if (i == self || throw_dice() % 10 == 0) continue;
    P2PPacket sent = *packet;
    if (throw_dice() % 50 == 0) sent.size /= 2;
    static_cast<void>(::send(radio[static_cast<std::size_t>(i)][1], &sent, sizeof sent, MSG_DONTWAIT));
  }
  return true;
}
std::uint64_t configblockGetRadioAddress() { return 0xE7E7E7E700U + static_cast<unsigned>(self); }

logVarId_t logGetVarId(const char* group, const char* name) {
  const std::string_view wanted_name = name;
  if (std::string_view(group) != "stateEstimate") return 0xFFFF;
  return wanted_name == "x" ? 0 : wanted_name == "y" ? 1 : wanted_name == "yaw" ? 2 : 0xFFFF;
}
float logGetFloat(logVarId_t id) { return id == 0 ? place.x : id == 1 ? place.y : id == 2 ? yaw_deg : NAN; }
void commanderSetSetpoint(setpoint_t* setpoint, int) { wanted = *setpoint; }

QueueHandle_t xQueueCreate(std::uint32_t length, std::uint32_t bytes) {
  queue_length = length;
  item_bytes = bytes;
  return &queue;
}
int xQueueSend(QueueHandle_t, const void* item, TickType_t) {
  if (queue.size() >= queue_length) return 0;
  const auto* const bytes = static_cast<const std::uint8_t*>(item);
  queue.emplace_back(bytes, bytes + item_bytes);
  return 1;
}
int xQueueReceive(QueueHandle_t, void* item, TickType_t) {
  if (queue.empty()) return 0;
  std::memcpy(item, queue.front().data(), item_bytes);
  queue.pop_front();
  return 1;
}
TickType_t xTaskGetTickCount() { return now_ms; }
void vTaskDelayUntil(TickType_t* woken, TickType_t ticks) {
  *woken = now_ms += ticks;
  for (TickType_t k = 0; k < ticks; k += 10) move(0.01F);
  ::usleep(wall_us_per_step);
  P2PPacket packet;
  while (::recv(radio[static_cast<std::size_t>(self)][0], &packet, sizeof packet, MSG_DONTWAIT) > 0) heard(&packet);
  // Where it is, every second, to whom it may concern.
  if (now_ms % 1000 == 0)
    static_cast<void>(::send(report[static_cast<std::size_t>(self)][1], &place, sizeof place, MSG_DONTWAIT));
  if (now_ms >= flight_ms) ::_exit(0);
}
}

int main() {
  for (auto* pairs : {&radio, &report})
    for (auto& pair : *pairs)
      if (::socketpair(AF_UNIX, SOCK_DGRAM, 0, pair.data()) != 0) return 1;
  for (self = 0; self < robots; ++self)
    if (::fork() == 0) {
      place = {0.4F * static_cast<float>(self % 3), 0.4F * static_cast<float>(self >= 3 ? 1 : 0)};
      yaw_deg = 50.0F * static_cast<float>(self);  // which nobody can tell from outside
      dice = static_cast<unsigned>(self + 1);
      appMain();
    }
  const timeval longest_silence{20, 0};  // of one that has crashed
  for (const auto& pair : report)
    ::setsockopt(pair[0], SOL_SOCKET, SO_RCVTIMEO, &longest_silence, sizeof longest_silence);
  int split = 0;
  std::array<Place, robots> places{};
  for (TickType_t second = 0; second < flight_ms / 1000; ++second) {
    for (std::size_t i = 0; i < robots; ++i)
      if (::recv(report[i][0], &places[i], sizeof(Place), 0) != sizeof(Place)) return 1;
    split += is_in_one_piece(places) ? 0 : 1;
  }
  while (::wait(nullptr) > 0) {}
  const double first_m = between(places[1], {3.0F, 0.5F}), second_m = between(places[2], {-3.0F, 0.0F});
  std::printf("workers are %.2f and %.2f m from their targets; in several parts at %d of %d moments\n", first_m,
              second_m, split, static_cast<int>(flight_ms / 1000));
  return first_m < 0.2 && second_m < 0.2 && split == 0 ? 0 : 1;
}
