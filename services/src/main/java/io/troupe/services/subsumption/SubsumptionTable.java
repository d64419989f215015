package io.troupe.services.subsumption;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.stream.Collectors;

/**
 * Which colour puts which services in charge.
 *
 * <p><b>Role.</b> Immutable; made by {@link #forRobots} or taken as the paper has it, {@link #ofThePaper()}. The first state is the one to begin with.
 * <p><b>Order.</b> Colours that are in no state (black, orange and all others) change nothing.
 * <p><b>Source.</b> Paper, section 3.3, Tables 3 and 4 (Table 4 wins over the list of rules); challenge v.
 */
public final class SubsumptionTable {
    private final List<State> states;

    private SubsumptionTable(List<State> states) {
        this.states = List.copyOf(states);
    }

    /** Table 4: blue, red and green for two robots. */
    public static SubsumptionTable ofThePaper() {
        return forRobots(2)
                .when(Colours.BLUE, Service.WALL_FOLLOWER, Service.SPACE_WANDERER)
                .when(Colours.RED, Service.SPACE_WANDERER, Service.WALL_FOLLOWER)
                .when(Colours.GREEN, Service.SPACE_WANDERER, Service.SPACE_WANDERER)
                .build();
    }

    /** Begins a table for a number of robots. */
    public static Builder forRobots(int robots) {
        return new Builder(robots);
    }

    /** The state to begin with. */
    public State first() {
        return states.getFirst();
    }

    /** All states, by number. */
    public List<State> states() {
        return states;
    }

    /** The services that any state puts in charge, in the order in which the table names them. */
    public List<Service> services() {
        return states.stream()
                .flatMap(state -> state.services().stream())
                .distinct()
                .toList();
    }

    /** The state that a colour leads to, if it leads to one. */
    public Optional<State> state(int colour) {
        return states.stream().filter(state -> state.colour() == colour).findFirst();
    }

    /** The state that follows when a robot sees a colour: another state, or nothing. */
    public Optional<State> next(State current, int seenColour) {
        return seenColour == current.colour() ? Optional.empty() : state(seenColour);
    }

    public int robots() {
        return first().services().size();
    }

    /** Collects states and checks them. */
    public static final class Builder {
        private final int robots;
        private final List<State> states = new ArrayList<>();
        private boolean finalAllowed;

        private Builder(int robots) {
            if (robots < 1) {
                throw new IllegalArgumentException("a table is for " + robots + " robots, expected 1 or more");
            }
            this.robots = robots;
        }

        /**
         * Adds the next state.
         *
         * @throws IllegalArgumentException if the colour has a state already, or there is not exactly one service per robot
         */
        public Builder when(int colour, Service... services) {
            if (services.length != robots) {
                throw new IllegalArgumentException("the state of " + Colours.name(colour) + " names " + services.length
                        + " services, expected one for each of " + robots + " robots");
            }
            states.stream()
                    .filter(state -> state.colour() == colour)
                    .findFirst()
                    .ifPresent(state -> {
                        throw new IllegalArgumentException(
                                Colours.name(colour) + " leads to state " + state.number() + " already");
                    });
            states.add(new State(states.size() + 1, colour, List.of(services)));
            return this;
        }

        /** Accepts states that never end, because no robot in them looks for colours. */
        public Builder allowFinal() {
            finalAllowed = true;
            return this;
        }

        /**
         * The table.
         *
         * @throws IllegalStateException if there is no state, or one can be reached that never ends and that was not allowed
         */
        public SubsumptionTable build() {
            if (states.isEmpty()) {
                throw new IllegalStateException("the table has no state: add one with when(..)");
            }
            State first = states.getFirst();
            var reachable = first.canEnd() ? states : List.of(first);
            var ends = reachable.stream().filter(state -> !state.canEnd()).toList();
            if (!ends.isEmpty() && !finalAllowed) {
                throw new IllegalStateException(
                        ends.stream()
                                        .map(state ->
                                                "state " + state.number() + " (" + Colours.name(state.colour()) + ")")
                                        .collect(Collectors.joining(", "))
                                + " can be reached and never ends, because no robot in it looks for colours: put a service that does in charge of one, or say allowFinal()");
            }
            return new SubsumptionTable(states);
        }
    }
}
