package io.troupe.services.subsumption;

import io.troupe.services.behaviour.ColourFinder;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.TreeMap;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * Which colour puts which services in charge: any number of robots, services and colours.
 *
 * <p><b>Role.</b> Immutable; made by {@link #forRobots}, taken as the paper has it, {@link #ofThePaper()}, or read from a file by
 * {@link SubsumptionTableReader}. The first state is the one to begin with.
 * <p><b>Order.</b> Colours that are in no state change nothing, whether they are named as ignored or not.
 * <p><b>Source.</b> Paper, section 3.3, Tables 3 and 4 (Table 4 wins over the list of rules); challenge v.
 */
public final class SubsumptionTable {
    private final List<State> states;
    private final Map<Integer, State> byColour;
    private final Map<Integer, Integer> priorities;
    private final Map<Integer, String> ignored;
    private final Map<Integer, String> names;
    private final double holdSeconds;
    private final boolean finalAllowed;

    private SubsumptionTable(Builder builder) {
        states = List.copyOf(builder.states);
        byColour = states.stream().collect(Collectors.toUnmodifiableMap(State::colour, state -> state));
        priorities = Collections.unmodifiableMap(new TreeMap<>(builder.priorities));
        ignored = Collections.unmodifiableMap(new LinkedHashMap<>(builder.ignored));
        names = Collections.unmodifiableMap(new LinkedHashMap<>(builder.names));
        holdSeconds = builder.holdSeconds;
        finalAllowed = builder.finalAllowed;
    }

    /** Table 4: blue, red and green for two robots. */
    public static SubsumptionTable ofThePaper() {
        return ofThePaper(CornerStyle.FORWARD);
    }

    /** Table 4 with another way round corners. */
    public static SubsumptionTable ofThePaper(CornerStyle cornerStyle) {
        Service wallFollower = Service.wallFollower(cornerStyle);
        return forRobots(2)
                .ignoring(Colours.BLACK, "walls and robot 2")
                .ignoring(Colours.ORANGE, "robot 1")
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
        return Optional.ofNullable(byColour.get(colour));
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

    /** The priorities that were given, by colour. */
    public Map<Integer, Integer> priorities() {
        return priorities;
    }

    /** How long a state lasts before a colour that is not of higher priority ends it; 0 unless told otherwise. */
    public double holdSeconds() {
        return holdSeconds;
    }

    /** The colours that are reserved, so that they lead to no state, and why, in the order in which they were named. */
    public Map<Integer, String> ignored() {
        return ignored;
    }

    /** The names that the table itself gives to colours, in the order in which it does. */
    public Map<Integer, String> declaredColours() {
        return names;
    }

    /** Whether it may have states that never end. */
    public boolean allowsFinal() {
        return finalAllowed;
    }

    /** What the table calls a colour: the name that it declares, else the known one, else {@code #RRGGBB}. */
    public String colourName(int colour) {
        String declared = names.get(colour);
        if (declared != null) {
            return declared;
        }
        String known = Colours.name(colour);
        return names.containsValue(known) ? Colours.hex(colour) : known; // the table calls another colour so
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

    @Override
    public boolean equals(@Nullable Object other) {
        return other instanceof SubsumptionTable that
                && states.equals(that.states)
                && priorities.equals(that.priorities)
                && ignored.equals(that.ignored)
                && names.equals(that.names)
                && holdSeconds == that.holdSeconds
                && finalAllowed == that.finalAllowed;
    }

    @Override
    public int hashCode() {
        return Objects.hash(states, priorities, ignored, names, holdSeconds, finalAllowed);
    }

    @Override
    public String toString() {
        return "table of " + states.size() + " states for " + robots() + " robots";
    }

    /** Collects states and checks them. */
    public static final class Builder {
        private static final Pattern WORD = Pattern.compile(TableLine.WORD);

        private final int robots;
        private final List<State> states = new ArrayList<>();
        private final Map<Integer, Integer> priorities = new TreeMap<>();
        private final Map<Integer, String> ignored = new LinkedHashMap<>();
        private final Map<Integer, String> names = new LinkedHashMap<>();
        private final List<Service> declared = new ArrayList<>();
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
            return when(colour, List.of(services));
        }

        /** Adds the next state, by ranges of robots. */
        public Builder when(int colour, Assignment assignment) {
            return when(colour, assignment.services(robots));
        }

        /** Adds the next state. */
        public Builder when(int colour, List<Service> services) {
            requireColour(colour);
            if (services.size() != robots) {
                throw new IllegalArgumentException("the state of " + name(colour) + " names " + services.size()
                        + " services, expected one for each of " + robots + " robots");
            }
            for (State state : states) {
                if (state.colour() == colour) {
                    throw new IllegalArgumentException(name(colour) + " leads to state " + state.number() + " already");
                }
            }
            states.add(new State(states.size() + 1, colour, services));
            return this;
        }

        /**
         * Gives a colour a name, and says that it must have a state or be ignored.
         *
         * @param name a word: a letter, then letters, digits, {@code -} and {@code _}
         * @throws IllegalArgumentException if the colour has a name, or the name a colour
         */
        public Builder colour(String name, int colour) {
            requireColour(colour);
            if (!WORD.matcher(name).matches()) {
                throw new IllegalArgumentException(
                        "the colour " + Colours.hex(colour) + " is called '" + name + "', expected a word");
            }
            if (names.containsValue(name)) {
                throw new IllegalArgumentException("the colour " + name + " is declared already");
            }
            String other = names.putIfAbsent(colour, name);
            if (other != null) {
                throw new IllegalArgumentException(
                        "the colour " + Colours.hex(colour) + " is called " + other + " already, and not " + name);
            }
            return this;
        }

        /** Says that some state must use this service. */
        public Builder service(Service service) {
            declared.add(service);
            return this;
        }

        /**
         * Reserves a colour: it leads to no state.
         *
         * @param why one line without {@code #}, for people; may be empty
         */
        public Builder ignoring(int colour, String why) {
            requireColour(colour);
            if (why.indexOf('#') >= 0 || why.lines().count() > 1 || !why.strip().equals(why)) {
                throw new IllegalArgumentException("the reason to ignore " + name(colour) + " is '" + why
                        + "', expected one line without '#' and without blanks around it");
            }
            if (ignored.putIfAbsent(colour, why) != null) {
                throw new IllegalArgumentException(name(colour) + " is ignored already");
            }
            return this;
        }

        /** Lets a colour count more (or less) than the others, which have 0: a robot that sees several reports the one that counts most. */
        public Builder priority(int colour, int priority) {
            priorities.put(colour, priority);
            return this;
        }

        /** Lets each state last so long, unless a colour of higher priority than its own ends it. */
        public Builder hold(double seconds) {
            if (!(seconds >= 0) || Double.isInfinite(seconds)) {
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
         * @throws IllegalStateException if something is missing in it, or contradicts itself: no state, a state that never begins, or never ends although
         *     that was not allowed, an ignored colour with a state, a declared colour or service without one, two services of one name, layers that
         *     never drive
         */
        public SubsumptionTable build() {
            finding().ifPresent(finding -> {
                throw new IllegalStateException(finding.message());
            });
            return new SubsumptionTable(this);
        }

        /** What is wrong, if anything is. */
        Optional<TableChecks.Finding> finding() {
            return new TableChecks(new SubsumptionTable(this), declared).first();
        }

        private String name(int colour) {
            return names.getOrDefault(colour, Colours.name(colour));
        }

        private static void requireColour(int colour) {
            if (colour < 0 || colour > Colours.LAST) {
                throw new IllegalArgumentException(
                        String.format("the colour is 0x%X, expected 0x000000 to 0xFFFFFF", colour));
            }
        }
    }
}
