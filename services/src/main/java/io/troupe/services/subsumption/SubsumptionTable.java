package io.troupe.services.subsumption;

import io.troupe.services.behaviour.ColourFinder;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
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
    private final Map<Integer, Integer> priorities;
    private final double holdSeconds;

    private SubsumptionTable(Builder builder) {
        states = List.copyOf(builder.states);
        priorities = Map.copyOf(builder.priorities);
        holdSeconds = builder.holdSeconds;
    }

    /** Table 4: blue, red and green for two robots. */
    public static SubsumptionTable ofThePaper() {
        return ofThePaper(CornerStyle.FORWARD);
    }

    /** Table 4 with another way round corners. */
    public static SubsumptionTable ofThePaper(CornerStyle cornerStyle) {
        Service wallFollower =
                cornerStyle == CornerStyle.FORWARD ? Service.WALL_FOLLOWER : Service.wallFollower(cornerStyle);
        return forRobots(2)
                .when(Colours.BLUE, wallFollower, Service.SPACE_WANDERER)
                .when(Colours.RED, Service.SPACE_WANDERER, wallFollower)
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

    /** The service of a name, if any state puts it in charge. */
    public Optional<Service> service(String name) {
        return services().stream()
                .filter(service -> service.name().equals(name))
                .findFirst();
    }

    /** How much a colour counts: 0 unless told otherwise. */
    public int priority(int colour) {
        return priorities.getOrDefault(colour, 0);
    }

    /** How long a state lasts before a colour that is not of higher priority ends it; 0 unless told otherwise. */
    public double holdSeconds() {
        return holdSeconds;
    }

    /** The state that follows when a robot sees a colour and the state has lasted long enough: another state, or nothing. */
    public Optional<State> next(State current, int seenColour) {
        return seenColour == current.colour() ? Optional.empty() : state(seenColour);
    }

    /** The state that follows when a robot sees a colour: another state, or nothing. */
    public Optional<State> next(State current, int seenColour, double secondsInState) {
        boolean mayEnd = secondsInState >= holdSeconds || priority(seenColour) > priority(current.colour());
        return mayEnd ? next(current, seenColour) : Optional.empty();
    }

    /** What the colour finders of a state look for: the colour of the highest priority that ends it, of equal ones the largest. */
    public ColourRule ruleIn(State state) {
        return (sightings, secondsInCharge) -> ColourFinder.inOrder(sightings, this::priority)
                .filter(colour -> next(state, colour, secondsInCharge).isPresent())
                .findFirst();
    }

    public int robots() {
        return first().services().size();
    }

    /** Collects states and checks them. */
    public static final class Builder {
        private final int robots;
        private final List<State> states = new ArrayList<>();
        private final Map<Integer, Integer> priorities = new HashMap<>();
        private double holdSeconds;
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

        /** Lets a colour count more (or less) than the others, which have 0: a robot that sees several reports the one that counts most. */
        public Builder priority(int colour, int priority) {
            priorities.put(colour, priority);
            return this;
        }

        /** Lets each state last so long, unless a colour of higher priority than its own ends it. */
        public Builder hold(double seconds) {
            if (!(seconds >= 0)) {
                throw new IllegalArgumentException("a state is held for " + seconds + " s, expected 0 or more");
            }
            holdSeconds = seconds;
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
            checkNames();
            return new SubsumptionTable(this);
        }

        private void checkNames() {
            var named = new HashMap<String, Service>();
            for (var state : states) {
                for (var service : state.services()) {
                    Service other = named.putIfAbsent(service.name(), service);
                    if (other != null && !other.equals(service)) {
                        throw new IllegalStateException("two different services are called " + service.name()
                                + ": make it once and use it in every state, or give them different names");
                    }
                }
            }
        }
    }
}
