package io.troupe.services.subsumption;

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
 * Which colour puts which services in charge: any number of robots, services and colours.
 *
 * <p><b>Role.</b> Immutable; made by {@link #forRobots}, taken as the paper has it, {@link #ofThePaper()}, or read from
 * a file by {@link SubsumptionTableReader}. The first state is the one to begin with.
 *
 * <p><b>Order.</b> Colours that are in no state change nothing, whether they are named as ignored or not.
 *
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

    SubsumptionTable(SubsumptionTableBuilder builder) {
        states = builder.states();
        byColour = states.stream().collect(Collectors.toUnmodifiableMap(State::colour, state -> state));
        priorities = builder.priorities();
        ignored = builder.ignored();
        names = builder.names();
        holdSeconds = builder.holdSeconds();
        finalAllowed = builder.finalAllowed();
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
    public static SubsumptionTableBuilder forRobots(int robots) {
        return new SubsumptionTableBuilder(robots);
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

    /**
     * The state that follows when a robot sees a colour and the state has lasted long enough: another state, or
     * nothing.
     */
    public Optional<State> next(State current, int seenColour) {
        return seenColour == current.colour() ? Optional.empty() : state(seenColour);
    }

    /** The state that follows when a robot sees a colour: another state, or nothing. */
    public Optional<State> next(State current, int seenColour, double secondsInState) {
        boolean mayEnd = secondsInState >= holdSeconds || priority(seenColour) > priority(current.colour());
        return mayEnd ? next(current, seenColour) : Optional.empty();
    }

    /**
     * What the colour finders of a state look for: the colour of the highest priority that ends it, of equal ones the
     * largest.
     */
    public ColourRule ruleIn(State state) {
        return (blobs, secondsInCharge) -> ColourFinder.inOrder(blobs, this::priority)
                .filter(colour -> next(state, colour, secondsInCharge).isPresent())
                .findFirst();
    }

    public int robots() {
        return first().services().size();
    }

    /** Whether any state gives a robot, by Player index, a service that uses its laser. */
    boolean usesLaser(int robot) {
        return robot >= 0
                && robot < robots()
                && states.stream().anyMatch(state -> state.services().get(robot).usesLaser());
    }

    /** The robots, by number from 1, that some state gives a service that uses the laser, so that they need one. */
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
