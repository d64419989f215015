package io.troupe.services.subsumption;

import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;
import java.util.regex.Pattern;

/**
 * Collects the states of a {@link SubsumptionTable} and checks them.
 *
 * <p><b>Role.</b> Made by {@link SubsumptionTable#forRobots}.
 *
 * <p><b>Errors.</b> What is wrong by itself is refused at once, with an {@link IllegalArgumentException}; what is wrong
 * with the table as a whole, by {@link #build}.
 */
public final class SubsumptionTableBuilder {
    private static final Pattern WORD = Pattern.compile(TableLine.WORD);

    private final int robots;
    private final List<State> states = new ArrayList<>();
    private final Map<Integer, Integer> priorities = new TreeMap<>();
    private final Map<Integer, String> ignored = new LinkedHashMap<>();
    private final Map<Integer, String> names = new LinkedHashMap<>();
    private final List<Service> declared = new ArrayList<>();
    private double holdSeconds;
    private boolean finalAllowed;

    SubsumptionTableBuilder(int robots) {
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
    public SubsumptionTableBuilder when(int colour, Service... services) {
        return when(colour, List.of(services));
    }

    /** Adds the next state, by ranges of robots. */
    public SubsumptionTableBuilder when(int colour, Assignment assignment) {
        return when(colour, assignment.services(robots));
    }

    /** Adds the next state. */
    public SubsumptionTableBuilder when(int colour, List<Service> services) {
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
    public SubsumptionTableBuilder colour(String name, int colour) {
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
    public SubsumptionTableBuilder service(Service service) {
        declared.add(service);
        return this;
    }

    /**
     * Reserves a colour: it leads to no state.
     *
     * @param why one line without {@code #}, for people; may be empty
     */
    public SubsumptionTableBuilder ignoring(int colour, String why) {
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

    /**
     * Lets a colour count more (or less) than the others, which have 0: a robot that sees several reports the one that
     * counts most.
     */
    public SubsumptionTableBuilder priority(int colour, int priority) {
        Integer before = priorities.putIfAbsent(colour, priority);
        if (before != null) {
            throw new IllegalArgumentException(
                    name(colour) + " has priority " + before + " already, and not " + priority);
        }
        return this;
    }

    /** Lets each state last so long, unless a colour of higher priority than its own ends it. */
    public SubsumptionTableBuilder hold(double seconds) {
        if (!(seconds >= 0) || Double.isInfinite(seconds)) {
            throw new IllegalArgumentException("a state is held for " + seconds + " s, expected 0 or more");
        }
        holdSeconds = seconds + 0.0; // -0 is 0
        return this;
    }

    /** Accepts states that never end, because no robot in them looks for colours. */
    public SubsumptionTableBuilder allowFinal() {
        finalAllowed = true;
        return this;
    }

    /**
     * The table.
     *
     * @throws IllegalStateException if something is missing in it, or contradicts itself: no state, a state that never
     *     begins, or never ends although that was not allowed, an ignored colour with a state, a declared colour or
     *     service without one, two services of one name, layers that never drive
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

    /** Copies, in their order, for the table. */
    List<State> states() {
        return List.copyOf(states);
    }

    Map<Integer, Integer> priorities() {
        return Collections.unmodifiableMap(new TreeMap<>(priorities));
    }

    Map<Integer, String> ignored() {
        return Collections.unmodifiableMap(new LinkedHashMap<>(ignored));
    }

    Map<Integer, String> names() {
        return Collections.unmodifiableMap(new LinkedHashMap<>(names));
    }

    double holdSeconds() {
        return holdSeconds;
    }

    boolean finalAllowed() {
        return finalAllowed;
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
