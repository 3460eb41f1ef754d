// SPDX-License-Identifier: MIT
// The root and the holders of targets are the same thing: a token, whose holder counts rounds. All robots pass on the
// newest counts and the places; the nearest free robot takes the token of a holder that has fallen silent.
#include "caravan/rules.hpp"

namespace banyan::caravan {
namespace {

constexpr int takeover_beats = 60;               // a new holder's count starts so far ahead of the news under way
constexpr int rival_beats = takeover_beats / 2;  // a count farther behind mine is that of a dead holder
constexpr int urgent_rounds = 40;                // for so long a new holder has priority
constexpr float news_rounds = 4.0F;     // a token, and as many for each C to its place: robots tell of all in turn
constexpr int first_root_rounds = 200;  // by then the first root would have been heard
constexpr float beside = 1.0F;          // C: only a robot so near to where the root was may become root
constexpr float trust = 0.2F;           // in a place that is only remembered
constexpr float least_edge = 0.3F;      // C: of a shorter one the bearing of a round ago is too wrong

Token* find(State& self, RobotId name) noexcept {
  for (Token& t : self.known())
    if (t.name == name) return &t;
  return nullptr;
}

// Finds tokens by the last bits of their names: every packet is about one.
class Index {
 public:
  explicit Index(State& self) noexcept : tokens_(self.tokens) {
    for (std::size_t k = 0; k < self.token_count; ++k) at_[tokens_[k].name % places] = static_cast<std::uint8_t>(k);
  }
  // Null if it is not known, or another one has its place.
  [[nodiscard]] Token* find(RobotId name) const noexcept {
    Token& t = tokens_[at_[name % places]];
    return t.name == name ? &t : nullptr;
  }

 private:
  static constexpr std::size_t places = 128;
  std::array<Token, most_tokens>& tokens_;
  std::array<std::uint8_t, places> at_{};
};

// Memory for most_tokens; of more targets the nearest are kept.
Token* add(State& self, RobotId name, Vec2 place) noexcept {
  if (self.token_count < most_tokens) {
    Token& t = self.tokens[self.token_count++];
    t = {};
    t.name = name;
    return &t;
  }
  Token* farthest = nullptr;
  for (Token& t : self.known())
    if (t.name != root_name && t.name != self.serves && (farthest == nullptr || norm(t.place) > norm(farthest->place)))
      farthest = &t;
  if (farthest == nullptr || norm(farthest->place) <= norm(place)) return nullptr;
  *farthest = {};
  farthest->name = name;
  return farthest;
}

void announce(Token& t, RobotId holder) noexcept {
  t.holder = holder;
  t.beat = advanced(t.beat, takeover_beats);
  t.age = 0;
  t.urgent = urgent_rounds;
  t.reached = false;
}

bool is_there(const Robot& robot, const Token& t) noexcept {
  return t.located && norm(t.place) <= robot.params.arrival_distance;
}

// First the one that is there, then the robot first sent, then the smaller id.
bool has_precedence(RobotId a, bool a_reached, RobotId b, bool b_reached, RobotId name) noexcept {
  if (a_reached != b_reached) return a_reached;
  return a == name || (b != name && a < b);
}

void become_root(Robot& robot) noexcept {
  State& self = robot.self;
  Token& root = self.tokens[0];
  self.root = self.newest = {advanced(self.newest.sequence), self.id};
  root.holder = self.id, root.age = 0, root.place = {}, root.located = true;
  self.parent = nobody;
}

void take_news(State& self, Token& t, const TokenNews& news) noexcept {
  if (news.holder == put_off && t.holder != put_off) self.stuck_rounds = 0;  // robots may suffice now
  t.holder = news.holder, t.beat = news.beat, t.reached = news.reached, t.age = 0;
}

// I am told where it is. The robot first sent there is told by the mission; while it lives, news of its own place is
// best, and of several copies the newest. All others only remember, and what they remember is averaged. Once the root
// is silent, copies of copies would only drift.
void locate(const Robot& robot, Token& t, const TokenNews& news, Vec2 place) noexcept {
  constexpr int stale = 3;  // rounds
  const State& self = robot.self;
  if (t.name == root_name) {
    if (news.holder != self.newest.id || (t.located && t.age > robot.liveness())) return;
    t.place = place;
  } else {
    if (self.was_sent && t.name == self.id) return;
    const bool by_memory = t.holder != t.name || t.age > 2 * robot.liveness() + self.token_count;
    if (!t.located || (!by_memory && ahead_by(news.beat, t.beat) >= -stale)) t.place = place;
    else if (by_memory) t.place += (place - t.place) * trust;
  }
  t.located = true;
}

// Another robot is said to hold my target. A count far behind mine is that of a dead one.
void settle_rivalry(Robot& robot, Token& t, const TokenNews& news) noexcept {
  State& self = robot.self;
  if (news.holder == self.id || news.holder == nobody || ahead_by(news.beat, t.beat) < -rival_beats) return;
  if (!robot.is_station && has_precedence(news.holder, news.reached, self.id, t.reached, news.name)) {
    self.serves = nobody;
    take_news(self, t, news);
    t.urgent = urgent_rounds;
  } else {
    t.beat = advanced(news.beat, takeover_beats);  // so that it hears of me
  }
}

// I am said to hold it: it is handed over to me, or that is old news, from before I resigned.
void accept(Robot& robot, Token& t, const Message& m) noexcept {
  State& self = robot.self;
  if (self.serves != nobody && t.name != root_name && is_news(m.token.beat, t.beat, t.age)) {
    t.beat = m.token.beat;
    announce(t, vacant);  // I have another one; as I am heard, nobody would take me for lost
  }
  if (self.role != Role::spare || robot.is_root() || self.serves != nobody) return;
  if (t.name == root_name) {
    if (m.id == self.newest.id) become_root(robot);
  } else if (is_news(m.token.beat, t.beat, t.age)) {
    self.serves = t.name;
    announce(t, self.id);
  }
}

void hear_token(Robot& robot, const Heard& h) noexcept {
  State& self = robot.self;
  const TokenNews& news = h.message->token;
  if (news.name == nobody) return;
  // What the sender wrote refers to where both were a round ago; over a distance an old bearing makes a large error.
  const Vec2 written = {news.x.value(), news.y.value()};
  bool told = news.told == self.id && !(h.before == Vec2{});
  Vec2 place = robot.carry.point({}) + from_edge_frame(written, robot.carry.vector(h.before));
  Token* t = find(self, news.name);
  // Who does not know the place yet takes what another one is told, if it hears both.
  if (const int k = told || (t != nullptr && t->located) ? -1 : robot.table().find(news.told);
      k >= 0 && distance(h.position, robot.position(k)) > least_edge) {
    told = true;
    place = robot.position(k) + from_edge_frame(written, h.position - robot.position(k));
  }
  if (t == nullptr) {
    if (!told || (t = add(self, news.name, place)) == nullptr) return;
    t->beat = advanced(news.beat, -1);
    t->holder = news.holder;
  }
  if (told) locate(robot, *t, news, place);
  t->charging |= news.charging;
  if (news.name == self.serves) return settle_rivalry(robot, *t, news);
  if (news.holder == self.id) return accept(robot, *t, *h.message);
  // The beats of the root's token are those of the order, which are heard from everybody.
  if (news.name == root_name || !is_news(news.beat, t->beat, t->age)) return;
  if (news.holder != t->holder) t->urgent = urgent_rounds;
  take_news(self, *t, news);
}

void follow_root(Robot& robot) noexcept {
  State& self = robot.self;
  Token& root = self.tokens[0];
  root.name = root_name;
  for (const Heard& h : robot.heard) {
    const Message& m = *h.message;
    if (m.id == self.id || m.root.id == nobody) continue;
    const bool is_new_root = is_newer(m.root, self.newest);
    if (!is_new_root && m.root != self.newest) continue;
    const bool advances = root.holder != m.root.id || is_news(m.beat, root.beat, root.age);
    if (!advances && m.id != m.root.id) continue;  // most tell nothing new
    if (is_new_root) self.newest = m.root;
    if (advances) root.holder = m.root.id, root.beat = m.beat, root.age = 0;
    if (m.id == m.root.id) root.place = h.position, root.located = true;
  }
  if (robot.is_root()) root.holder = self.id, root.beat = self.beat, root.age = 0, root.place = {}, root.located = true;
}

void mind_own(Robot& robot, const Orders& orders) noexcept {
  State& self = robot.self;
  for (Token& t : self.known())
    if (t.name != root_name && t.holder == self.id && t.name != self.serves) announce(t, nobody);
  if (orders.target && self.was_sent) {
    Token* t = find(self, self.id);
    if (t == nullptr) t = add(self, self.id, *orders.target);
    if (t != nullptr) t->place = *orders.target, t->located = true, t->charging = orders.charging_place;
  }
  if (self.serves == nobody) return;
  if (Token* t = find(self, self.serves); t != nullptr) {
    if (const int k = self.leaving ? heir(robot) : -1; k >= 0 && t->located) {
      self.serves = nobody;
      announce(*t, robot.table().id(k));
      ++self.tally.handovers;
      return;
    }
    t->holder = self.id, t->age = 0, t->reached = is_there(robot, *t);
    t->beat = advanced(t->beat, robot.elapsed_rounds);
  }
}

bool is_silent(const Robot& robot, const Token& t) noexcept {
  const Params& p = robot.params;
  const float later = p.takeover_spread * norm(t.place);
  if (t.holder == put_off) return robot.self.call.source == nobody && t.age > p.rounds(p.retry_drives) + whole(later);
  if (t.holder == vacant) return t.age > whole(later);
  const float late =
      t.name == root_name ? 0.0F : news_rounds * static_cast<float>(robot.self.token_count) * (1.0F + norm(t.place));
  return t.age > 2 * robot.liveness() + whole(p.takeover_rounds + later + late);
}

// Who is tied to a holder knows first that it has died. News of one that is heard is not late.
void watch_holders(Robot& robot) noexcept {
  const Table& table = robot.table();
  const int patience = 2 * robot.liveness() + whole(robot.params.takeover_rounds);
  for (Token& t : robot.self.known()) {
    const int k = t.name == root_name || t.age <= patience ? -1 : table.find(t.holder);
    if (k < 0 || robot.said(k).role != Role::worker) continue;
    if (table.age(k) <= patience) t.age = static_cast<std::uint16_t>(table.age(k));
    else announce(t, vacant);
  }
}

// Nobody has ever heard of a root: the smallest id among those that hear each other.
bool misses_first_root(const Robot& robot) noexcept {
  const Table& table = robot.table();
  if (robot.self.newest.id != nobody || robot.self.since_start <= first_root_rounds + 6 * robot.lease() ||
      table.size() == 0)
    return false;
  for (int k = 0; k < table.size(); ++k)
    if (!robot.is_lost(k) && table.id(k) < robot.self.id && robot.said(k).role != Role::worker) return false;
  return true;
}

void take_over(Robot& robot) noexcept {
  State& self = robot.self;
  if (robot.is_root() || self.serves != nobody) return;
  Token& root = self.tokens[0];
  if (misses_first_root(robot) ||
      (root.located && self.newest.id != nobody && norm(root.place) < beside && is_silent(robot, root))) {
    become_root(robot);
    ++self.tally.elections;
    return;
  }
  if (self.role != Role::spare || self.unfit || root.age > 2 * robot.liveness()) return;
  for (Token& t : self.known()) {
    if (t.name == root_name || !t.located || t.holder == nobody || !is_silent(robot, t)) continue;
    self.serves = t.name;
    announce(t, self.id);
    ++self.tally.replacements;
    return;
  }
}

}  // namespace

// A robot that has resigned, or serves another's target, stays with that, however long it is sent.
void follow_orders(Robot& robot, const Orders& orders) noexcept {
  State& self = robot.self;
  const bool called_back = self.was_sent && (!orders.sent || orders.given_up == self.id);
  if (self.serves != nobody && ((called_back && self.serves == self.id) || self.serves == orders.given_up))
    self.serves = nobody;
  if (orders.sent && (!self.was_sent || called_back)) self.serves = self.id;
  self.was_sent = orders.sent;
  // Who was sent there first tells it even if nobody serves the target now: a spare would try again.
  for (const RobotId ended : {called_back ? self.id : nobody, orders.given_up})
    if (Token* t = ended == nobody ? nullptr : find(self, ended); t != nullptr && t->holder != nobody)
      announce(*t, nobody);
}

void keep_tokens(Robot& robot, const Orders& orders) noexcept {
  State& self = robot.self;
  robot.add_elapsed(self.since_start);
  for (Token& t : self.known()) {
    robot.add_elapsed(t.age);
    t.urgent = static_cast<std::uint8_t>(std::max(0, t.urgent - robot.elapsed_rounds));
  }
  mind_own(robot, orders);
  follow_root(robot);
  const Index index(self);
  for (const Heard& h : robot.heard) {
    // Most news is old: no newer count of what others hold, told to somebody else.
    const TokenNews& news = h.message->token;
    if (news.told != self.id && news.holder != self.id && news.name != self.serves)
      if (const Token* t = index.find(news.name);
          t != nullptr && t->located && (news.name == root_name || !is_news(news.beat, t->beat, t->age)))
        continue;
    if (h.message->id != self.id) hear_token(robot, h);
  }
  watch_holders(robot);
  take_over(robot);
}

void watch_progress(Robot& robot, Vec2 v) noexcept {
  constexpr float nearer = 0.05F;  // C
  constexpr float in_vain = 1.0F;
  State& self = robot.self;
  const Params& p = robot.params;
  Token* const t = self.serves == nobody ? nullptr : find(self, self.serves);
  if (t == nullptr || !t->located || t->reached || robot.is_station) {
    self.nearest = not_counted, self.effort = 0.0F, self.stuck_rounds = 0;
    return;
  }
  const float way = norm(t->place);
  if (way < self.nearest - nearer) self.nearest = way, self.effort = 0.0F, self.stuck_rounds = 0;
  const auto rounds = static_cast<float>(robot.elapsed_rounds);
  self.effort = std::max(0.0F, self.effort + dot(v, unit(t->place)) * p.way_in_a_round() * rounds);
  if (self.call.source == nobody) self.stuck_rounds = 0;
  else robot.add_elapsed(self.stuck_rounds);
  // As long as a spare takes to come from the root, and then some; the farthest target takes most robots, and its
  // worker loses patience first.
  const float patience = from_fixed(self.label) + p.give_up_drives * (1.0F + 1.0F / (1.0F + way));
  const bool waits_in_vain = self.stuck_rounds > p.rounds(patience);
  if (self.effort < in_vain && !waits_in_vain) return;
  self.unfit |= self.effort >= in_vain;
  self.serves = nobody;
  announce(*t, waits_in_vain ? put_off : vacant);
}

// The next token, or every second time the next that is urgent; the neighbour that is told places changes with each
// turn.
TokenNews told_in_turn(Robot& robot) noexcept {
  State& self = robot.self;
  const Table& table = robot.table();
  const auto after = [&](int at) { return static_cast<std::uint8_t>((at + 1) % self.token_count); };
  std::uint8_t next = after(self.urgent_turn);
  for (int k = 0; k < self.token_count && self.tokens[next].urgent == 0; ++k) next = after(next);
  if (self.round % 2 == 0 || self.tokens[next].urgent == 0) {
    next = self.turn = after(self.turn);
    if (next == 0) self.token.told = table.next_heard(self.token.told, 0);
  } else {
    self.urgent_turn = next;
  }
  const Token& t = self.tokens[next];
  TokenNews news{t.name, t.holder, t.beat, t.reached, t.charging, nobody, {}, {}};
  // A root that runs low offers its token to a robot beside it.
  if (t.name == root_name && robot.is_root() && self.leaving)
    if (const int k = heir(robot); k >= 0) news.holder = table.id(k);
  if (const int k = t.located ? table.find(self.token.told) : -1; k >= 0 && table.age(k) == 0) {
    news.told = self.token.told;
    write_in_edge_frame(t.place - table.position(k), table.position(k), news.x, news.y);
  }
  return news;
}

bool is_cut_off(const Robot& robot) noexcept {
  const Token& root = robot.self.tokens[0];
  const bool known = root.located && root.holder != nobody && root.holder == robot.self.newest.id;
  return !robot.is_root() && known && root.age > 2 * robot.lease() + whole(robot.params.retreat_rounds);
}

}  // namespace banyan::caravan
