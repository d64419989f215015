package io.troupe.petri.wiring;

import java.util.ArrayDeque;
import java.util.Collection;
import java.util.HashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;
import java.util.function.Function;
import java.util.stream.Collectors;

/**
 * The states in which a component can be after what it was seen to do: the subset construction of its protocol, made
 * only as far as it is needed. A private step that is not observed may happen at any time.
 *
 * <p><b>Threads.</b> Not thread-safe: states are added while a run is followed.
 */
final class PossibleStates {
    /** What a component does in an event in which it takes part. */
    enum Part {
        ASKS,
        IS_TAKEN,
        IS_ANSWERED,
        TAKES,
        ANSWERS,
        DOES;

        /** The part of the caller, or of the component that takes a private step. */
        static Part ofCaller(ProtocolEvent.Kind kind) {
            return switch (kind) {
                case ASKED -> ASKS;
                case TAKEN -> IS_TAKEN;
                case ANSWERED -> IS_ANSWERED;
                case DID -> DOES;
            };
        }
    }

    /**
     * An event as one component takes part in it.
     *
     * @param what the call as {@code provider.call}; of a provider {@code caller.call}; of a private step its label
     */
    record Move(Part part, String what) {}

    /** Where a component is: in a state, or in a step of its protocol that takes time. */
    private sealed interface Position {
        record In(String state) implements Position {
            @Override
            public String toString() {
                return "is in \"" + state + "\"";
            }
        }

        record Asking(String target, String next) implements Position {
            @Override
            public String toString() {
                return "waits for " + target + ", which is not accepted yet";
            }
        }

        record Served(String target, String next) implements Position {
            @Override
            public String toString() {
                return "waits for the answer of " + target;
            }
        }

        record Serving(String callersCall, String next) implements Position {
            @Override
            public String toString() {
                return "answers " + callersCall.substring(callersCall.indexOf('.') + 1) + " to "
                        + callersCall.substring(0, callersCall.indexOf('.'));
            }
        }
    }

    /** The steps of a protocol by the state from which they lead. */
    private final Map<String, List<Step>> steps;

    private final Function<Step.Requests, String> provider;
    private final Set<String> observed;
    private final Map<Set<Position>, Situation> situations = new HashMap<>();
    private final Situation first;

    /**
     * Starts in the first state.
     *
     * @param provider the component that answers a request
     * @param observed the labels of the private steps that are observed
     */
    PossibleStates(
            String first, Collection<Step> steps, Function<Step.Requests, String> provider, Set<String> observed) {
        this.steps = steps.stream().collect(Collectors.groupingBy(Step::from));
        this.provider = provider;
        this.observed = observed;
        this.first = situation(Set.of(new Position.In(first)));
    }

    Situation first() {
        return first;
    }

    /** Adds what unobserved private steps and stops lead to. */
    private Situation situation(Set<Position> positions) {
        var all = new LinkedHashSet<>(positions);
        var ahead = new ArrayDeque<>(positions);
        while (!ahead.isEmpty()) {
            if (ahead.remove() instanceof Position.In at) {
                for (var step : steps.getOrDefault(at.state(), List.of())) {
                    var next = new Position.In(step.to());
                    if (isSilent(step) && all.add(next)) {
                        ahead.add(next);
                    }
                }
            }
        }
        return situations.computeIfAbsent(Set.copyOf(all), Situation::new);
    }

    private boolean isSilent(Step step) {
        return step instanceof Step.Stops || step instanceof Step.Does does && !observed.contains(does.label());
    }

    /** A set of positions, and where each event leads from it. */
    final class Situation {
        private final Set<Position> positions;
        private final Map<Move, Situation> next = new HashMap<>();

        private Situation(Set<Position> positions) {
            this.positions = positions;
        }

        /** The situation after a move; an impossible one if no position allows it. */
        Situation after(Move move) {
            var known = next.get(move);
            if (known == null) {
                known = compute(move);
                next.put(move, known);
            }
            return known;
        }

        private Situation compute(Move move) {
            var found = new LinkedHashSet<Position>();
            for (var position : positions) {
                switch (position) {
                    case Position.In at -> {
                        for (var step : steps.getOrDefault(at.state(), List.of())) {
                            add(found, move, step);
                        }
                    }
                    case Position.Asking it -> {
                        if (move.equals(new Move(Part.IS_TAKEN, it.target()))) {
                            found.add(new Position.Served(it.target(), it.next()));
                        }
                    }
                    case Position.Served it -> {
                        if (move.equals(new Move(Part.IS_ANSWERED, it.target()))) {
                            found.add(new Position.In(it.next()));
                        }
                    }
                    case Position.Serving it -> {
                        if (move.equals(new Move(Part.ANSWERS, it.callersCall()))) {
                            found.add(new Position.In(it.next()));
                        }
                    }
                }
            }
            return situation(found);
        }

        private void add(Set<Position> found, Move move, Step step) {
            if (step instanceof Step.Requests request && move.part() == Part.ASKS) {
                var target = target(request);
                if (target.equals(move.what())) {
                    found.add(new Position.Asking(target, request.to()));
                }
            } else if (step instanceof Step.Provides offer && move.part() == Part.TAKES) {
                if (move.what().endsWith("." + offer.call())) {
                    found.add(new Position.Serving(move.what(), offer.to()));
                }
            } else if (step instanceof Step.Does does && move.part() == Part.DOES) {
                if (observed.contains(does.label()) && does.label().equals(move.what())) {
                    found.add(new Position.In(does.to()));
                }
            }
        }

        boolean isImpossible() {
            return positions.isEmpty();
        }

        /** Whether the component may have no call under way. */
        boolean mayRest() {
            return positions.stream().anyMatch(Position.In.class::isInstance);
        }

        /** Whether it must be in one of these states. */
        boolean isWithin(Set<String> states) {
            return positions.stream().allMatch(each -> each instanceof Position.In at && states.contains(at.state()));
        }

        /** What can be observed next, in the words of the declaration. */
        Set<String> allowed() {
            var found = new TreeSet<String>();
            for (var position : positions) {
                switch (position) {
                    case Position.In at -> {
                        for (var step : steps.getOrDefault(at.state(), List.of())) {
                            if (step instanceof Step.Requests request) {
                                found.add("ask " + target(request));
                            } else if (step instanceof Step.Provides offer) {
                                found.add("take " + offer.call());
                            } else if (!isSilent(step) && step instanceof Step.Does does) {
                                found.add("do \"" + does.label() + "\"");
                            }
                        }
                    }
                    case Position.Asking it -> found.add("have " + it.target() + " accepted");
                    case Position.Served it -> found.add("get the answer of " + it.target());
                    case Position.Serving it ->
                        found.add("answer "
                                + it.callersCall().substring(it.callersCall().indexOf('.') + 1));
                }
            }
            return found;
        }

        private String target(Step.Requests request) {
            return provider.apply(request) + "." + request.call();
        }

        /** For example {@code is in "ready" or is in "loaded"}. */
        @Override
        public String toString() {
            return positions.stream().map(Position::toString).sorted().collect(Collectors.joining(" or "));
        }
    }
}
