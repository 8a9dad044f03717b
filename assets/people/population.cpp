#include "assets/population.h"

#include <array>
#include <span>
#include <utility>

#include "sim/base/rng.h"

namespace flaneur {

namespace {

enum class AgeGroup { child, adult, old };

// Draws for one kind of person of one sex, who each take the next card of every deck.
struct Dealer {
    uint64_t seed;
    uint32_t group;  // of the kind and sex
    uint32_t nth;    // person of the group
    uint32_t decks = 0;

    // The next card of a deck that is shuffled anew whenever it has run out.
    template <class T>
    T deal(std::span<const T> deck) {
        std::array<uint8_t, 32> order;
        uint32_t size = static_cast<uint32_t>(deck.size());
        RandomKey key{seed, group, nth / size, Purpose::accessory};
        for (uint32_t i = 0; i < size; ++i) order[i] = static_cast<uint8_t>(i);
        for (uint32_t i = size; i > 1; --i)
            std::swap(order[i - 1], order[random_bits(key, decks * 32 + i) % i]);
        ++decks;
        return deck[order[nth % size]];
    }
    template <class T, size_t N>
    T deal(const T (&deck)[N]) {
        return deal(std::span<const T>(deck));
    }
    // Whether it is this one of `of`.
    bool one_in(uint32_t of) {
        std::array<uint8_t, 32> deck{1};
        return deal(std::span<const uint8_t>(deck.data(), of)) != 0;
    }
};

void dress_child(PersonOptions& p, Dealer& d) {
    static constexpr Hair girls[] = {Hair::ponytail, Hair::bangs, Hair::shoulder_length, Hair::long_hair},
                          boys[] = {Hair::full, Hair::parted, Hair::cropped, Hair::curly};
    static constexpr Bottom girls_wear[] = {Bottom::dress, Bottom::slim, Bottom::shorts, Bottom::skirt},
                            boys_wear[] = {Bottom::shorts, Bottom::straight, Bottom::straight};
    p.hair = p.woman ? d.deal(girls) : d.deal(boys);
    p.bottom = p.woman ? d.deal(girls_wear) : d.deal(boys_wear);
    p.top = d.deal<Top>({Top::hoodie, Top::t_shirt, Top::sweater});
    if (p.bottom == Bottom::dress) p.top = Top::t_shirt;
    p.over = d.deal<Over>({Over::vest, Over::none, Over::jacket});
    if (p.bottom == Bottom::shorts || p.bottom == Bottom::dress) p.over = Over::none;
    p.bag = d.deal<Bag>({Bag::backpack, Bag::none});
    p.hat = d.deal<Hat>({Hat::none, Hat::cap});
    p.glasses = d.one_in(5);
}

void dress_woman(PersonOptions& p, Dealer& d, AgeGroup kind) {
    static constexpr Hair young[] = {Hair::long_hair, Hair::bob,      Hair::bun,
                                     Hair::ponytail,  Hair::curly,    Hair::shoulder_length,
                                     Hair::bangs,     Hair::long_hair},
                          grey[] = {Hair::bob, Hair::curly, Hair::bun, Hair::cropped, Hair::shoulder_length};
    static constexpr Bottom young_wear[] = {Bottom::slim,  Bottom::dress,    Bottom::wide,
                                            Bottom::skirt, Bottom::straight, Bottom::long_skirt,
                                            Bottom::slim,  Bottom::shorts},
                            old_wear[] = {Bottom::straight, Bottom::skirt, Bottom::long_skirt, Bottom::slim};
    bool old = kind == AgeGroup::old;
    p.hair = old ? d.deal(grey) : d.deal(young);
    p.bottom = old ? d.deal(old_wear) : d.deal(young_wear);
    p.top = d.deal<Top>({Top::sweater, Top::t_shirt, Top::shirt, Top::hoodie, Top::sweater});
    p.over = d.deal<Over>({Over::none, Over::coat, Over::open_jacket, Over::none, Over::jacket, Over::vest});
    p.shoes = d.deal<Shoes>({Shoes::pumps, Shoes::sneakers, Shoes::boots, Shoes::leather});
    p.bag = d.deal<Bag>({Bag::handbag, Bag::none, Bag::shoulder_bag, Bag::backpack, Bag::none});
    p.hat = d.deal<Hat>(
        {Hat::none, Hat::none, Hat::none, Hat::brimmed, Hat::none, Hat::none, Hat::none, Hat::none});
}

void dress_man(PersonOptions& p, Dealer& d, AgeGroup kind) {
    static constexpr Hair young[] = {Hair::cropped, Hair::parted,  Hair::full, Hair::curly,
                                     Hair::parted,  Hair::cropped, Hair::bald, Hair::shoulder_length},
                          grey[] = {Hair::bald, Hair::parted, Hair::cropped};
    bool old = kind == AgeGroup::old;
    p.hair = old ? d.deal(grey) : d.deal(young);
    p.beard = d.deal<Beard>({Beard::none, Beard::full, Beard::none, Beard::moustache, Beard::none});
    p.bottom = d.deal<Bottom>({Bottom::straight, Bottom::slim, Bottom::straight, Bottom::wide,
                               Bottom::straight, Bottom::slim, Bottom::shorts});
    if (old) p.bottom = Bottom::straight;
    p.top = d.deal<Top>({Top::shirt, Top::t_shirt, Top::hoodie, Top::sweater, Top::shirt});
    p.over = d.deal<Over>({Over::none, Over::jacket, Over::coat, Over::none, Over::open_jacket, Over::vest});
    p.shoes = d.deal<Shoes>({Shoes::leather, Shoes::sneakers, Shoes::boots, Shoes::sneakers});
    p.bag = d.deal<Bag>({Bag::none, Bag::backpack, Bag::shoulder_bag, Bag::none});
    p.hat = d.deal<Hat>(
        {Hat::none, Hat::cap, Hat::none, Hat::none, Hat::beanie, Hat::none, Hat::none, Hat::none});
    Hat aged = d.deal<Hat>({Hat::none, Hat::brimmed, Hat::cap});
    if (old) p.hat = aged;
}

// What cannot be worn together gives way.
void agree(PersonOptions& p) {
    bool light = p.bottom == Bottom::shorts;
    if (p.bottom == Bottom::dress && p.top != Top::sweater) p.top = Top::t_shirt;
    if (light) {
        if (p.top == Top::sweater) p.top = Top::t_shirt;
        if (p.over == Over::coat || p.over == Over::jacket) p.over = Over::none;
        if (p.shoes != Shoes::pumps) p.shoes = Shoes::sneakers;
    }
    if (p.bottom == Bottom::long_skirt && p.over == Over::coat) p.over = Over::none;
    if (p.top == Top::hoodie && p.over != Over::none && p.over != Over::vest) p.top = Top::sweater;
    if (p.top == Top::t_shirt && p.over == Over::coat) p.top = Top::sweater;
    if (p.hair == Hair::bun) p.hat = Hat::none;
    if (p.hat != Hat::none) p.headphones = false;
    if (p.bag == Bag::handbag && p.stick) p.bag = Bag::shoulder_bag;
    if (p.stick) p.phone = false;
    if (!p.pram) return;
    p.bag = Bag::none;
    p.scarf = p.phone = p.stick = false;
}

float draw_height(const PersonOptions& p, RandomKey key) {
    float spread = p.woman ? 0.065f : 0.07f;
    return mean_height(p.woman, p.age) * (1 + clamp(random_normal(key, 3), -2, 2) * spread / 1.69f);
}

}  // namespace

float mean_height(bool woman, float age) {
    struct Growth {
        float age, girl, boy;
    };
    static constexpr Growth growth[] = {{5, 1.09f, 1.10f},  {7, 1.21f, 1.22f},  {9, 1.33f, 1.33f},
                                        {11, 1.45f, 1.43f}, {13, 1.56f, 1.56f}, {15, 1.61f, 1.69f},
                                        {18, 1.62f, 1.755f}};
    auto height = [&](const Growth& g) { return woman ? g.girl : g.boy; };
    for (size_t i = 1; i < std::size(growth); ++i)
        if (age < growth[i].age) {
            const Growth &a = growth[i - 1], &b = growth[i];
            return lerp(height(a), height(b), clamp((age - a.age) / (b.age - a.age), 0, 1));
        }
    // The spine settles: some three centimetres between sixty and eighty.
    return height(growth[6]) - 0.03f * smoothstep(55, 85, age);
}

std::vector<PersonOptions> draw_population(uint32_t count, uint64_t seed) {
    std::vector<PersonOptions> people;
    uint32_t met[3] = {0, 0, 0};
    for (uint32_t i = 0; i < count; ++i) {
        // Among 24: three children, four old.
        AgeGroup kind = i % 8 == 2 ? AgeGroup::child : (i % 6 == 3 ? AgeGroup::old : AgeGroup::adult);
        uint32_t of_kind = met[static_cast<size_t>(kind)]++;
        PersonOptions p;
        p.seed = mix(seed ^ mix(i + 1));
        p.woman = (of_kind + (kind == AgeGroup::child)) % 2 == 1;
        Dealer d{seed, static_cast<uint32_t>(kind) * 2 + p.woman, of_kind / 2};
        RandomKey key{p.seed, 0, 0, Purpose::body};
        switch (kind) {
            case AgeGroup::child: {
                // The youngest, one at school, one half grown.
                static constexpr float ages[] = {6, 14, 10};
                p.age = ages[of_kind % 3] + random_between(key, -1, 1.5f, 1);
                break;
            }
            case AgeGroup::adult:
                p.age = 18 + 42 * random_unit(key, 1) * (0.5f + 0.5f * random_unit(key, 2));
                break;
            case AgeGroup::old:
                p.age = random_between(key, 66, 85, 1);
                break;
        }
        p.height = draw_height(p, key);
        p.build = clamp(random_normal(key, 4) * 0.45f + 0.3f * smoothstep(30, 60, p.age), -1, 1);
        if (kind == AgeGroup::child) p.build *= 0.5f;
        if (kind == AgeGroup::child)
            dress_child(p, d);
        else if (p.woman)
            dress_woman(p, d, kind);
        else
            dress_man(p, d, kind);
        if (kind != AgeGroup::child) {
            p.glasses = d.one_in(kind == AgeGroup::old ? 2 : 4);
            p.scarf = d.one_in(5);
            p.headphones = d.one_in(6);
            p.phone = d.one_in(5);
            p.stick = d.one_in(2);
            if (p.bottom == Bottom::shorts) p.scarf = false;
            if (kind == AgeGroup::old) p.headphones = p.phone = false;
            if (kind == AgeGroup::adult) p.stick = false;
        }
        agree(p);
        people.push_back(p);
    }
    return people;
}

std::vector<Pusher> draw_pushers(uint64_t seed) {
    // About so many of a street's people are of that age and sex.
    constexpr float k_of_age = 0.23f, k_grandparents = 0.002f;
    constexpr struct {
        bool woman;
        float from, to, share;
    } k_who[] = {{true, 22, 45, k_pushing * k_of_age},
                 {false, 22, 45, k_pushing * k_of_age},
                 {true, 55, 70, k_grandparents}};
    std::vector<Pusher> pushers;
    for (const auto& who : k_who) {
        const auto i = static_cast<uint32_t>(pushers.size());
        PersonOptions p;
        p.seed = mix(seed ^ mix(i + 0x70a30001));
        p.woman = i == 2 ? p.seed % 2 == 0 : who.woman;
        p.pram = true;
        RandomKey key{p.seed, 0, 0, Purpose::body};
        p.age = random_between(key, who.from, who.to, 1);
        p.height = draw_height(p, key);
        p.build = clamp(random_normal(key, 4) * 0.45f, -1, 1);
        Dealer d{seed, 6 + i, 0};
        p.woman ? dress_woman(p, d, AgeGroup::adult) : dress_man(p, d, AgeGroup::adult);
        p.glasses = d.one_in(4);
        agree(p);
        pushers.push_back({p, who.share});
    }
    return pushers;
}

}  // namespace flaneur
