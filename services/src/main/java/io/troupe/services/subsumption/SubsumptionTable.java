package io.troupe.services.subsumption;

import io.troupe.common.text.NamedColours;
import io.troupe.services.behaviour.ColourFinder;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * The table of states: which colour leads to which services, for any number of robots, services and colours.
 *
 * <p><b>Role.</b> Immutable. Build one with {@link #forRobots}, take the paper's with {@link #ofThePaper()}, or read
 * one from a file with {@link SubsumptionTableReader}. A run starts in the first state.
 *
 * <p><b>Order.</b> Colours without a state change nothing, whether they are declared as ignored or not.
 *
 * <p><b>Source.</b> Paper, section 3.3, Tables 3 and 4 (Table 4 takes precedence over the list of rules); challenge v.
 */
public final class SubsumptionTable {
    /** The table without states, of a run in which robots have no services. */
    public static final SubsumptionTable NONE = new SubsumptionTable(forRobots(1));

    private final List<State> states;
    private final Map<Integer, State> byColour;
    private final List<Service> services;
    private final Map<String, Service> byName;
    private final Map<Integer, Integer> priorities;
    private final Map<Integer, String> ignored;
    private final Map<Integer, String> names;
    private final double holdSeconds;
    private final boolean finalAllowed;

    SubsumptionTable(SubsumptionTableBuilder builder) {
        states = builder.states();
        byColour = states.stream().collect(Collectors.toUnmodifiableMap(State::colour, state -> state));
        services = states.stream()
                .flatMap(state -> state.services().stream())
                .distinct()
                .toList();
        // a table that has not been checked yet may have two services of one name
        byName = services.stream().collect(Collectors.toUnmodifiableMap(Service::name, each -> each, (a, b) -> a));
        priorities = builder.priorities();
        ignored = builder.ignored();
        names = builder.names();
        holdSeconds = builder.holdSeconds();
        finalAllowed = builder.finalAllowed();
    }

    /** Table 4 of the paper: blue, red and green for two robots. */
    public static SubsumptionTable ofThePaper() {
        return ofThePaper(CornerStyle.FORWARD);
    }

    /** Table 4 of the paper with a choice of the wall followers' corner style. */
    public static SubsumptionTable ofThePaper(CornerStyle cornerStyle) {
        Service wallFollower = Service.wallFollower(cornerStyle);
        return forRobots(2)
                .ignoring(NamedColours.BLACK, "walls and robot 2")
                .ignoring(NamedColours.ORANGE, "robot 1")
                .state(NamedColours.BLUE, wallFollower, Service.SPACE_WANDERER)
                .state(NamedColours.RED, Service.SPACE_WANDERER, wallFollower)
                .state(NamedColours.GREEN, Service.SPACE_WANDERER, Service.SPACE_WANDERER)
                .build();
    }

    /** Returns a builder for a number of robots. */
    public static SubsumptionTableBuilder forRobots(int robots) {
        return new SubsumptionTableBuilder(robots);
    }

    /** The state in which a run starts. */
    public State first() {
        return states.getFirst();
    }

    /** All states, in order of their numbers. */
    public List<State> states() {
        return states;
    }

    /** All services of all states, each once, in the order of the table. */
    public List<Service> services() {
        return services;
    }

    /** Returns the state that a colour leads to. */
    public Optional<State> state(int colour) {
        return Optional.ofNullable(byColour.get(colour));
    }

    /** Returns the service with a name, if a state uses it. */
    public Optional<Service> service(String name) {
        return Optional.ofNullable(byName.get(name));
    }

    /** The priority of a colour; 0 by default. */
    public int priority(int colour) {
        return priorities.getOrDefault(colour, 0);
    }

    /** The explicit priorities, by colour. */
    public Map<Integer, Integer> priorities() {
        return priorities;
    }

    /**
     * The minimum duration of a state in seconds; 0 by default. A colour with a higher priority than the state's own
     * can end it earlier.
     */
    public double holdSeconds() {
        return holdSeconds;
    }

    /** The ignored colours, which lead to no state, with the reason for each, in the order of declaration. */
    public Map<Integer, String> ignored() {
        return ignored;
    }

    /** The colour names that the table declares, in the order of declaration. */
    public Map<Integer, String> declaredColours() {
        return names;
    }

    /** Whether the table may have states that never end. */
    public boolean allowsFinal() {
        return finalAllowed;
    }

    /** Returns the name of a colour: the declared name, else the standard name, else {@code #RRGGBB}. */
    public String colourName(int colour) {
        String declared = names.get(colour);
        if (declared != null) {
            return declared;
        }
        String known = NamedColours.name(colour);
        return names.containsValue(known)
                ? NamedColours.hex(colour)
                : known; // the table uses that name for another colour
    }

    /**
     * Returns the state that follows if a robot sees a colour, regardless of the hold time; empty if the state does not
     * change.
     */
    public Optional<State> next(State current, int seenColour) {
        return seenColour == current.colour() ? Optional.empty() : state(seenColour);
    }

    /** Returns the state that follows if a robot sees a colour; empty if the state does not change. */
    public Optional<State> next(State current, int seenColour, double secondsInState) {
        boolean mayEnd = secondsInState >= holdSeconds || priority(seenColour) > priority(current.colour());
        return mayEnd ? next(current, seenColour) : Optional.empty();
    }

    /**
     * Returns the rule of a state's colour finders: of the colours that end the state, the one with the highest
     * priority; of equal priorities, the largest blob's.
     */
    public ColourRule ruleIn(State state) {
        return (blobs, secondsInCharge) -> ColourFinder.inOrder(blobs, this::priority)
                .filter(colour -> next(state, colour, secondsInCharge).isPresent())
                .findFirst();
    }

    public int robots() {
        return first().services().size();
    }

    /** Whether any state gives a robot, by Player index, a service that uses the laser. */
    boolean usesLaser(int robot) {
        return robot >= 0
                && robot < robots()
                && states.stream().anyMatch(state -> state.services().get(robot).usesLaser());
    }

    /** The numbers, from 1, of the robots that need a laser, because a state gives them a service that uses it. */
    public List<Integer> robotsWithLaser() {
        return IntStream.rangeClosed(1, robots())
                .filter(number -> usesLaser(number - 1))
                .boxed()
                .toList();
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
}
