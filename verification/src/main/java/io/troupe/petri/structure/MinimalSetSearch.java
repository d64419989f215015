package io.troupe.petri.structure;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.Deque;
import java.util.List;

/**
 * Finds all minimal closed sets (siphons or traps, depending on the needs), each once, by the splitting of Cordone,
 * Ferrarini and Piroddi.
 *
 * <p>A problem is to find the minimal sets that contain all of {@code required} and nothing outside {@code allowed}.
 * Let S be one closed set among them, from which no further place can be removed. Every other minimal set lacks a place
 * of S, otherwise it would not be minimal; the first place that it lacks splits the problem into disjoint smaller ones.
 * S may still contain a smaller closed set that lacks a required place. Then S is not reported, but the split remains
 * correct. (Without that test the method reports sets that are not minimal.)
 */
final class MinimalSetSearch {
    private record Problem(BitSet allowed, BitSet required) {}

    private final Needs needs;
    private final Deque<Problem> open = new ArrayDeque<>();
    private final List<BitSet> found = new ArrayList<>();

    MinimalSetSearch(Needs needs) {
        this.needs = needs;
    }

    /** Solves up to {@code maxSteps} problems. Returns false if the search was cancelled or problems are left. */
    boolean run(long maxSteps) {
        try {
            return search(maxSteps);
        } catch (Needs.Cancelled end) {
            return false;
        }
    }

    private boolean search(long maxSteps) {
        var all = new BitSet();
        all.set(0, needs.places());
        open.push(new Problem(all, new BitSet()));
        for (var step = 0L; !open.isEmpty(); step++) {
            if (step == maxSteps) {
                return false;
            }
            needs.requireNotCancelled();
            solve(open.pop());
        }
        return true;
    }

    List<BitSet> found() {
        return found;
    }

    private void solve(Problem problem) {
        var allowed = problem.allowed();
        var required = problem.required();
        needs.shrinkToLargest(allowed);
        if (allowed.isEmpty() || !Needs.isSubset(required, allowed) || !require(required, allowed)) {
            return;
        }
        var inside = (BitSet) required.clone();
        needs.shrinkToLargest(inside);
        if (!inside.isEmpty()) {
            // a minimal set that contains this closed set equals it
            if (inside.equals(required)) {
                report(inside);
            }
            return;
        }
        var small = smallest(allowed, required);
        report(small);
        split(small, allowed, required);
    }

    /**
     * Adds the places that follow: the only allowed place that meets a need of a required one. False if a need cannot
     * be met.
     */
    private boolean require(BitSet required, BitSet allowed) {
        var pending = new ArrayDeque<Integer>();
        required.stream().forEach(pending::add);
        while (!pending.isEmpty()) {
            for (var need : needs.of(pending.pop())) {
                if (need.intersects(required)) {
                    continue;
                }
                var helpers = (BitSet) need.clone();
                helpers.and(allowed);
                var only = helpers.nextSetBit(0);
                if (only < 0) {
                    return false;
                }
                if (helpers.nextSetBit(only + 1) < 0) {
                    required.set(only);
                    pending.add(only);
                }
            }
        }
        return true;
    }

    /** A closed set between the two from which no place can be removed without losing a required one. */
    BitSet smallest(BitSet allowed, BitSet required) {
        var small = (BitSet) allowed.clone();
        for (var place = small.nextSetBit(0); place >= 0; place = small.nextSetBit(place + 1)) {
            if (required.get(place)) {
                continue;
            }
            var less = (BitSet) small.clone();
            less.clear(place);
            needs.shrinkToLargest(less);
            if (!less.isEmpty() && Needs.isSubset(required, less)) {
                small = less;
            }
        }
        return small;
    }

    private void report(BitSet set) {
        for (var place = set.nextSetBit(0); place >= 0; place = set.nextSetBit(place + 1)) {
            var less = (BitSet) set.clone();
            less.clear(place);
            needs.shrinkToLargest(less);
            if (!less.isEmpty()) {
                return;
            }
        }
        found.add(set);
    }

    private void split(BitSet small, BitSet allowed, BitSet required) {
        var kept = (BitSet) required.clone();
        for (var place = small.nextSetBit(0); place >= 0; place = small.nextSetBit(place + 1)) {
            if (kept.get(place)) {
                continue;
            }
            needs.requireNotCancelled();
            var without = (BitSet) allowed.clone();
            without.clear(place);
            open.push(new Problem(without, (BitSet) kept.clone()));
            kept.set(place);
        }
    }
}
