// What kind of person somebody is, and what of it shows in a street: in pace, in the room that is kept to
// others, in patience, in how long one stays, in the walk and in what the hands and the head do.
#pragma once

#include "sim/base/rng.h"
#include "sim/body/manner.h"

namespace flaneur {

// The five factors (Costa & McCrae), as standard scores: 0 is the middle of grown people, 1 a standard
// deviation above it. Within +-3.
struct Personality {
    float openness = 0, conscientiousness = 0, extraversion = 0, agreeableness = 0, neuroticism = 0;
};

// One person's, around the mean of an age (years) and sex. With age from 20 to 65 people grow more
// conscientious and more agreeable, and women less neurotic (Srivastava et al., J. Personality and Social
// Psychology 84, 2003); women are more neurotic by 0.4 and more agreeable by 0.15 (Schmitt et al., the same
// 94, 2008). The factors are drawn one by one.
Personality draw_personality(float age, bool woman, RandomKey key);
Personality usual_personality(float age, bool woman);

// How much faster than others of their age and sex, who are usually such, they like to walk, in standard
// deviations of these. Extraverted, conscientious and open people walk faster, neurotic ones slower; who is
// extraverted by 0.06 m/s (Stephan et al., Social Psychological and Personality Science 9, 2018). All else
// that makes one quick or slow is `own`, a standard score.
float pace_score(const Personality& personality, const Personality& usual, float own);

// Factor on the room that one keeps to those ahead, 0.85..1.2: the neurotic and the introverted keep more of
// it (as anxious people do to strangers: Sorokowska et al., J. Cross-Cultural Psychology 48, 2017). How much
// is judged.
float room_share(const Personality& personality);

// Factor on the time for which one bears to be held up before one presses on, 0.8..1.4: the agreeable and the
// conscientious wait, as who is judged assertive in crowds is neither (Guy et al., Symposium on Computer
// Animation 2011). How much is judged.
float patience_share(const Personality& personality);

// Factor on how long one stays where one stops, 0.6..1.5: the open and the sociable linger, the dutiful go
// on. Judged.
float linger_share(const Personality& personality);

// The walk and the habits of such a person instead of a middle one's. Arms swing and trunks move more with
// extraversion (Satchell et al., J. Nonverbal Behavior 41, 2017, found such with traits; how much is judged);
// who is low in spirits stoops, and swings the arms less (Michalak et al., Psychosomatic Medicine 71, 2009:
// a third less in depression). The shy cross their arms and hide their hands; the open look about.
void add_personality(Manner& manner, const Personality& personality);

}  // namespace flaneur
