#include "dds/belief_message.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "belief.h"
#include "dds/participant.hpp"
#include "io/belief_json.hpp"
#include "io/beliefs.hpp"

namespace credo::test {
namespace {

// All that JSON tells of a belief is told on DDS, to the bit.
TEST(BeliefMessage, TellsAllThatALineTells) {
  BeliefState kitchen = belief_of_a_kitchen();
  kitchen.floor->log_odds = 0.1;
  kitchen.walls[0].log_odds = 0.2;
  kitchen.objects[0].log_odds = -0.3;
  kitchen.stuff[0].log_odds = 0.4;
  for (BeliefState const& state : {kitchen, BeliefState()}) {
    BeliefSummary const belief = summary_of(state);
    BeliefMessage const message("robot-1", 7, belief);
    EXPECT_STREQ(message.sample().source, "robot-1");
    EXPECT_EQ(message.sample().revision, 7U);
    EXPECT_EQ(belief_json(belief_in(message.sample())), belief_json(belief));
  }
}

TEST(BeliefMessage, EachEvidenceHasItsWord) {
  BeliefSummary belief = summary_of(belief_of_a_kitchen());
  ASSERT_FALSE(belief.stuff.empty());
  for (Evidence const evidence : {Evidence::kSeen, Evidence::kSeenThrough, Evidence::kOccluded,
                                  Evidence::kOutOfView, Evidence::kNotSeen}) {
    belief.stuff[0].evidence = evidence;
    BeliefMessage const message("a", 1, belief);
    EXPECT_EQ(belief_in(message.sample()).stuff[0].evidence, evidence);
  }
  BeliefMessage const seen("a", 1, belief);
  credo_msg_Belief sample = seen.sample();
  sample.stuff._buffer[0].evidence = static_cast<credo_msg_Evidence>(7);
  EXPECT_THROW((void)belief_in(sample), std::runtime_error);
}

// Several to one, and none to the next.
TEST(BeliefMessage, TellsWhatBecameOneWithAThing) {
  BeliefSummary belief = summary_of(belief_of_a_kitchen());
  belief.stuff.push_back(belief.stuff.front());
  belief.stuff[0].joined_ids = {3, 5};
  BeliefMessage const message("a", 1, belief);
  BeliefSummary const read = belief_in(message.sample());
  EXPECT_EQ(read.stuff[0].joined_ids, belief.stuff[0].joined_ids);
  EXPECT_TRUE(read.stuff[1].joined_ids.empty());
}

// Where its names lie is the message's own matter.
TEST(BeliefMessage, OutlivesWhatItWasMadeOf) {
  auto belief = std::make_unique<BeliefSummary>();
  ObjectSummary& object = belief->objects.emplace_back();
  object.id = "a name that is too long to lie within a string";
  object.why = Account();
  std::string const expected = belief_json(*belief);
  BeliefMessage const message("a source that is too long to lie within a string", 1, *belief);
  belief.reset();
  EXPECT_EQ(belief_json(belief_in(message.sample())), expected);
}

TEST(Participant, WarnsOfSmallBuffersOnly) {
  EXPECT_EQ(receive_buffer_warning(4194304), std::nullopt);
  EXPECT_EQ(receive_buffer_warning(212992).value_or(""),
            "net.core.rmem_max is 212992 bytes: subscribers may lose samples of megabytes and wait "
            "for them again; as root, sysctl -w net.core.rmem_max=4194304");
}

}  // namespace
}  // namespace credo::test
