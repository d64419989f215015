package io.troupe.petri.deadlock;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.deadlock.DeadlockCheck.Reduction;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.function.BooleanSupplier;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * Makes a net smaller without changing whether it can deadlock. Each rule keeps this: the smaller net can reach a dead
 * marking if and only if the net can; and a trace to a dead marking of the smaller net can be translated.
 *
 * <p>The rules hold without priorities only; a net with different priorities is left as it is.
 *
 * <p><b>Source.</b> Berthelot, Checking properties of nets using transformations (1986), for most of the rules; the
 * conditions here are those under which the text of each rule proves it, with weights and inhibitor arcs.
 */
final class Reducer {
    /** A fused transition may replace at most so many others. */
    private static final int MAX_PAIRS = 12;

    /** How many places are tried to find those that imply one place. */
    private static final int MIN_TRIES = 40;

    private static final int MORE_TRIES = 4;

    private static final int MAX_FIRST_STEPS = 100_000;

    /** The firings of the original net that one transition of the smaller net stands for. */
    private sealed interface Firings {
        record One(int transition) implements Firings {}

        record Both(Firings first, Firings second) implements Firings {}
    }

    /** A transition of the smaller net: weights by place. */
    private record Step(
            Firings firings,
            TreeMap<Integer, Integer> in,
            TreeMap<Integer, Integer> out,
            TreeMap<Integer, Integer> inhibitors) {
        int change(int place) {
            return out.getOrDefault(place, 0) - in.getOrDefault(place, 0);
        }
    }

    private final PetriNet original;
    private final Set<String> placeNames;
    private final Set<Reduction> rules;
    private final BooleanSupplier cancelled;
    private final long[] tokens;
    private final boolean[] isGone;
    private final List<TreeSet<Integer>> producers = new ArrayList<>();
    private final List<TreeSet<Integer>> consumers = new ArrayList<>();
    private final List<TreeSet<Integer>> inhibited = new ArrayList<>();
    private final TreeMap<Integer, Step> steps = new TreeMap<>();
    private int nextStep;
    /** Fired before everything else. */
    private final List<Firings> first = new ArrayList<>();

    private Reducer(PetriNet net, Set<Reduction> rules, BooleanSupplier cancelled) {
        original = net;
        placeNames = net.places().stream().map(Place::name).collect(Collectors.toSet());
        this.rules = rules;
        this.cancelled = cancelled;
        tokens = net.places().stream().mapToLong(Place::tokens).toArray();
        isGone = new boolean[tokens.length];
        for (var ignored : tokens) {
            producers.add(new TreeSet<>());
            consumers.add(new TreeSet<>());
            inhibited.add(new TreeSet<>());
        }
        for (var t : net.transitions()) {
            var step = new Step(new Firings.One(t.index()), new TreeMap<>(), new TreeMap<>(), new TreeMap<>());
            t.inputs().forEach(arc -> step.in.put(arc.place().index(), arc.weight()));
            t.outputs().forEach(arc -> step.out.put(arc.place().index(), arc.weight()));
            t.inhibitors().forEach(arc -> step.inhibitors.put(arc.place().index(), arc.weight()));
            add(step);
        }
    }

    /** A smaller net, and how its traces translate. */
    static final class Reduced {
        private final Reducer reducer;
        private final List<Step> steps;
        private final PetriNet net;

        private Reduced(Reducer reducer) {
            this.reducer = reducer;
            steps = List.copyOf(reducer.steps.values());
            net = reducer.toNet(steps);
        }

        PetriNet net() {
            return net;
        }

        /** The trace of the original net for a trace of the smaller one. */
        int[] translate(int[] trace) {
            var whole = new ArrayList<Integer>();
            reducer.first.forEach(firings -> append(firings, whole));
            for (var t : trace) {
                append(steps.get(t).firings, whole);
            }
            return whole.stream().mapToInt(Integer::intValue).toArray();
        }

        private static void append(Firings all, List<Integer> whole) {
            var open = new ArrayList<>(List.of(all));
            while (!open.isEmpty()) {
                switch (open.removeLast()) {
                    case Firings.One one -> whole.add(one.transition);
                    case Firings.Both both -> {
                        open.add(both.second);
                        open.add(both.first);
                    }
                }
            }
        }
    }

    /** Applies {@code rules} until none applies, or until {@code cancelled} is true. */
    static Reduced reduce(PetriNet net, Set<Reduction> rules, BooleanSupplier cancelled) {
        var reducer = new Reducer(net, rules, cancelled);
        if (!net.isPrioritised()) {
            reducer.run();
        }
        return new Reduced(reducer);
    }

    /** Applies the rules in turns; a dear one only when no cheap one applies. */
    private void run() {
        for (var changed = true; changed && !cancelled.getAsBoolean(); ) {
            changed = false;
            for (var rule : Reduction.values()) {
                if (rules.contains(rule) && !(changed && rule == Reduction.IMPLIED_PLACES)) {
                    changed |= apply(rule);
                }
            }
        }
    }

    private boolean apply(Reduction rule) {
        return switch (rule) {
            case DEAD_TRANSITIONS -> removeDeadTransitions();
            case FREE_PLACES -> removeFreePlaces();
            case EQUAL_TRANSITIONS -> removeEqualTransitions();
            case FIRST_STEPS -> takeFirstSteps();
            case FUSED_AFTER -> fuseAll();
            case IMPLIED_PLACES -> removeImpliedPlaces();
            case EQUAL_PARTS -> false; // of the search, not of the net
        };
    }

    private void add(Step step) {
        var id = nextStep++;
        steps.put(id, step);
        step.in.keySet().forEach(place -> consumers.get(place).add(id));
        step.out.keySet().forEach(place -> producers.get(place).add(id));
        step.inhibitors.keySet().forEach(place -> inhibited.get(place).add(id));
    }

    private Step remove(int id) {
        var step = step(id);
        steps.remove(id);
        step.in.keySet().forEach(place -> consumers.get(place).remove(id));
        step.out.keySet().forEach(place -> producers.get(place).remove(id));
        step.inhibitors.keySet().forEach(place -> inhibited.get(place).remove(id));
        return step;
    }

    private Step step(int id) {
        var step = steps.get(id);
        if (step == null) {
            throw new IllegalStateException("transition " + id + " is gone");
        }
        return step;
    }

    private void removePlace(int place) {
        isGone[place] = true;
        consumers.get(place).forEach(id -> step(id).in.remove(place));
        producers.get(place).forEach(id -> step(id).out.remove(place));
        inhibited.get(place).forEach(id -> step(id).inhibitors.remove(place));
        consumers.get(place).clear();
        producers.get(place).clear();
        inhibited.get(place).clear();
    }

    /**
     * A transition that can never fire, even if no firing took tokens away: what it needs beyond the initial marking is
     * put by no transition that can fire. Nothing changes without it.
     */
    private boolean removeDeadTransitions() {
        var grows = new boolean[tokens.length];
        var fires = new TreeSet<Integer>();
        for (var changed = true; changed; ) {
            changed = false;
            for (var entry : steps.entrySet()) {
                var step = entry.getValue();
                if (!fires.contains(entry.getKey())
                        && step.in.entrySet().stream()
                                .allMatch(arc -> grows[arc.getKey()] || tokens[arc.getKey()] >= arc.getValue())) {
                    fires.add(entry.getKey());
                    step.out.keySet().stream()
                            .filter(place -> step.change(place) > 0)
                            .forEach(place -> grows[place] = true);
                    changed = true;
                }
            }
        }
        var dead = steps.keySet().stream().filter(id -> !fires.contains(id)).toList();
        dead.forEach(this::remove);
        return !dead.isEmpty();
    }

    /**
     * A place that never has fewer tokens than at first satisfies for ever the arcs for which these are enough; without
     * others it disables nothing. If its tokens never change, it may also inhibit transitions, and those that need
     * more, or that it inhibits, never fire.
     */
    private boolean removeFreePlaces() {
        var changed = false;
        for (var p = 0; p < tokens.length; p++) {
            var place = p;
            if (isGone[p] || consumers.get(p).stream().anyMatch(id -> step(id).change(place) < 0)) {
                continue;
            }
            if (producers.get(p).stream().allMatch(id -> step(id).change(place) == 0)) {
                removeConstantPlace(p);
                changed = true;
            } else if (inhibited.get(p).isEmpty()) {
                changed |= removeGrowingPlace(p);
            }
        }
        return changed;
    }

    private void removeConstantPlace(int place) {
        var never = new TreeSet<Integer>();
        consumers.get(place).stream()
                .filter(id -> step(id).in.getOrDefault(place, 0) > tokens[place])
                .forEach(never::add);
        inhibited.get(place).stream()
                .filter(id -> step(id).inhibitors.getOrDefault(place, 0) <= tokens[place])
                .forEach(never::add);
        never.forEach(this::remove);
        removePlace(place);
    }

    private boolean removeGrowingPlace(int place) {
        var satisfied = consumers.get(place).stream()
                .filter(id -> step(id).in.getOrDefault(place, 0) <= tokens[place])
                .toList();
        if (satisfied.size() == consumers.get(place).size()) {
            removePlace(place);
            return true;
        }
        for (var id : satisfied) {
            var step = remove(id);
            var change = step.change(place);
            step.in.remove(place);
            step.out.remove(place);
            if (change > 0) {
                step.out.put(place, change);
            }
            add(step);
        }
        return !satisfied.isEmpty();
    }

    /** A place that always has at least as many tokens as some others together disables nothing that they do not. */
    private boolean removeImpliedPlaces() {
        var changed = false;
        for (var p = 0; p < tokens.length; p++) {
            if (!isGone[p] && inhibited.get(p).isEmpty() && new Implication(p).isFound()) {
                removePlace(p);
                changed = true;
            }
        }
        return changed;
    }

    /**
     * Looks for places Q that imply a place p: p has at least the tokens of Q together at first, no firing changes p by
     * less than it changes Q, and each transition that takes tokens from p takes as many from Q.
     */
    private final class Implication {
        private final int place;
        private final TreeSet<Integer> chosen = new TreeSet<>();
        /** By transition: what it takes from p beyond what it takes from Q. */
        private final TreeMap<Integer, Long> uncovered = new TreeMap<>();
        /** By transition: the change of p less that of Q. */
        private final TreeMap<Integer, Long> lead = new TreeMap<>();

        /** The transitions that these make wrong. */
        private final TreeSet<Integer> wronglyCovered = new TreeSet<>();

        private final TreeSet<Integer> wronglyLed = new TreeSet<>();
        private long surplus;
        private int triesLeft;

        Implication(int place) {
            this.place = place;
            surplus = tokens[place];
            triesLeft = MIN_TRIES + MORE_TRIES * consumers.get(place).size();
            add(place, -1);
        }

        /** Adds a place to Q, or, with {@code sign} -1, takes it out again. */
        private void add(int q, int sign) {
            for (var id : consumers.get(q)) {
                var weight = (long) sign * step(id).in.getOrDefault(q, 0);
                note(wronglyCovered, id, uncovered.merge(id, -weight, Long::sum) > 0);
                note(wronglyLed, id, lead.merge(id, weight, Long::sum) < 0);
            }
            for (var id : producers.get(q)) {
                var weight = (long) sign * step(id).out.getOrDefault(q, 0);
                note(wronglyLed, id, lead.merge(id, -weight, Long::sum) < 0);
            }
        }

        private static void note(TreeSet<Integer> wrong, int id, boolean isWrong) {
            if (isWrong) {
                wrong.add(id);
            } else {
                wrong.remove(id);
            }
        }

        boolean isFound() {
            if (!wronglyCovered.isEmpty()) {
                return isFoundWithOneOf(wronglyCovered.first(), false);
            }
            return wronglyLed.isEmpty() || isFoundWithOneOf(wronglyLed.first(), true);
        }

        /** Tries to add each place that a transition takes tokens from. */
        private boolean isFoundWithOneOf(int id, boolean mustShrink) {
            for (var q : step(id).in.keySet()) {
                if (q == place || chosen.contains(q) || tokens[q] > surplus || mustShrink && step(id).change(q) >= 0) {
                    continue;
                }
                if (--triesLeft < 0) {
                    return false;
                }
                chosen.add(q);
                surplus -= tokens[q];
                add(q, 1);
                if (isFound()) {
                    return true;
                }
                add(q, -1);
                surplus += tokens[q];
                chosen.remove(q);
            }
            return false;
        }
    }

    /**
     * Of two transitions with the same arcs one suffices. One without an effect is not needed either, if another may
     * fire whenever it may.
     */
    private boolean removeEqualTransitions() {
        var changed = false;
        var known = new HashMap<List<Map<Integer, Integer>>, Integer>();
        for (var id : List.copyOf(steps.keySet())) {
            var step = step(id);
            var isImplied = step.in.equals(step.out) && isImplied(id, step);
            if (isImplied || known.putIfAbsent(List.of(step.in, step.out, step.inhibitors), id) != null) {
                remove(id);
                changed = true;
            }
        }
        return changed;
    }

    private boolean isImplied(int id, Step idle) {
        return idle.in.keySet().stream()
                .flatMap(place -> consumers.get(place).stream())
                .distinct()
                .filter(other -> other != id)
                .map(this::step)
                .anyMatch(other -> other.in.entrySet().stream()
                                .allMatch(arc -> idle.in.getOrDefault(arc.getKey(), 0) >= arc.getValue())
                        && other.inhibitors.entrySet().stream()
                                .allMatch(arc -> idle.inhibitors.containsKey(arc.getKey())
                                        && idle.inhibitors.get(arc.getKey()) <= arc.getValue()));
    }

    /**
     * A transition that needs only one place, and is the only one to take from it, is fired first. It stays ready until
     * it fires, so it fires before any deadlock; earlier it only gives others more tokens.
     */
    private boolean takeFirstSteps() {
        var fired = 0;
        for (var p = 0; p < tokens.length; p++) {
            if (isGone[p] || tokens[p] == 0 || consumers.get(p).size() != 1) {
                continue;
            }
            var step = step(consumers.get(p).first());
            if (isPrivate(step, p) && !step.out.containsKey(p)) {
                while (tokens[p] >= step.in.get(p) && first.size() < MAX_FIRST_STEPS && fits(step)) {
                    tokens[p] -= step.in.get(p);
                    step.out.forEach((place, weight) -> tokens[place] += weight);
                    first.add(step.firings);
                    fired++;
                }
            }
        }
        return fired > 0 && first.size() < tokens.length;
    }

    private boolean fits(Step step) {
        return step.out.entrySet().stream().allMatch(arc -> tokens[arc.getKey()] <= Long.MAX_VALUE - arc.getValue());
    }

    /** Whether a transition needs only {@code place}, and puts tokens where they inhibit nothing. */
    private boolean isPrivate(Step step, int place) {
        return step.in.size() == 1
                && step.in.containsKey(place)
                && step.inhibitors.isEmpty()
                && step.out.keySet().stream().allMatch(put -> inhibited.get(put).isEmpty());
    }

    private boolean fuseAll() {
        var changed = false;
        for (var p = 0; p < tokens.length; p++) {
            if (!isGone[p] && canFuse(p)) {
                fuse(p);
                changed = true;
            }
        }
        return changed;
    }

    /**
     * Whether every arc of the place has the same weight, more than its tokens, and the pairs that would arise are few
     * enough and have weights that can be added.
     */
    private boolean isBetween(int place) {
        var before = producers.get(place);
        var behind = consumers.get(place);
        if (before.isEmpty()
                || behind.isEmpty()
                || !inhibited.get(place).isEmpty()
                || before.stream().anyMatch(behind::contains)) {
            return false;
        }
        var weight = step(behind.first()).in.getOrDefault(place, 0);
        var pairs = (long) before.size() * behind.size();
        return tokens[place] < weight
                && (pairs <= Math.max(MAX_PAIRS, before.size() + behind.size()))
                && largestWeight(before) + largestWeight(behind) <= Integer.MAX_VALUE
                && behind.stream().allMatch(id -> step(id).in.get(place).equals(weight))
                && before.stream().allMatch(id -> step(id).out.get(place).equals(weight));
    }

    private long largestWeight(Set<Integer> ids) {
        return ids.stream()
                .map(this::step)
                .flatMap(step -> Stream.concat(step.in.values().stream(), step.out.values().stream()))
                .mapToLong(weight -> weight)
                .max()
                .orElse(0);
    }

    /**
     * Whether every transition behind the place needs nothing else. Then one of them can fire whenever the place is
     * marked, so it is not marked in a dead marking, and it does no harm to let that transition fire at once.
     */
    private boolean canFuse(int place) {
        return isBetween(place) && consumers.get(place).stream().allMatch(id -> isPrivate(step(id), place));
    }

    private void fuse(int place) {
        var front = List.copyOf(producers.get(place)).stream().map(this::remove).toList();
        var back = List.copyOf(consumers.get(place)).stream().map(this::remove).toList();
        for (var one : front) {
            for (var other : back) {
                var in = new TreeMap<>(one.in);
                var out = new TreeMap<>(other.out);
                var inhibitors = new TreeMap<>(one.inhibitors);
                other.in.forEach((from, weight) -> in.merge(from, weight, Math::addExact));
                one.out.forEach((to, weight) -> out.merge(to, weight, Math::addExact));
                other.inhibitors.forEach((at, weight) -> inhibitors.merge(at, weight, Math::min));
                in.remove(place);
                out.remove(place);
                add(new Step(new Firings.Both(one.firings, other.firings), in, out, inhibitors));
            }
        }
        removePlace(place);
    }

    private PetriNet toNet(List<Step> all) {
        var net = PetriNet.builder(original.name());
        var names = original.places();
        for (var p = 0; p < tokens.length; p++) {
            if (!isGone[p]) {
                net.place(names.get(p).name(), tokens[p]);
            }
        }
        var isPrioritised = original.isPrioritised();
        for (var i = 0; i < all.size(); i++) {
            var called = unusedName("step " + i);
            var step = all.get(i);
            net.transition(called);
            step.in.forEach((place, weight) -> net.arc(names.get(place).name(), called, weight));
            step.out.forEach((place, weight) -> net.arc(called, names.get(place).name(), weight));
            step.inhibitors.forEach(
                    (place, weight) -> net.inhibitor(names.get(place).name(), called, weight));
            if (isPrioritised) {
                net.priority(called, original.transitions().get(i).priority());
            }
        }
        return net.build();
    }

    /** A place may have any name, also that of a step. */
    private String unusedName(String wanted) {
        var name = wanted;
        while (placeNames.contains(name)) {
            name += "'";
        }
        return name;
    }
}
