package io.troupe.services.subsumption;

import io.troupe.common.text.LineSyntax;
import io.troupe.common.text.NamedColours;
import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;
import java.util.regex.Pattern;

/**
 * Builds a {@link SubsumptionTable} and checks it.
 *
 * <p><b>Role.</b> Created by {@link SubsumptionTable#forRobots}.
 *
 * <p><b>Errors.</b> A single wrong argument is rejected at once with an {@link IllegalArgumentException}; an error of
 * the table as a whole is rejected by {@link #build}.
 */
public final class SubsumptionTableBuilder {
    private static final Pattern WORD = Pattern.compile(LineSyntax.NAME);

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
    public SubsumptionTableBuilder state(int colour, Service... services) {
        return state(colour, List.of(services));
    }

    /** Adds the next state, with an assignment by ranges of robots. */
    public SubsumptionTableBuilder state(int colour, Assignment assignment) {
        return state(colour, assignment.services(robots));
    }

    /** Adds the next state. */
    public SubsumptionTableBuilder state(int colour, List<Service> services) {
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
     * Declares a name for a colour. A declared colour must have a state or be ignored.
     *
     * @param name a word: a letter, then letters, digits, {@code .}, {@code -} and {@code _}
     * @throws IllegalArgumentException if the colour has a name already, or the name a colour
     */
    public SubsumptionTableBuilder colour(String name, int colour) {
        requireColour(colour);
        if (!WORD.matcher(name).matches()) {
            throw new IllegalArgumentException(
                    "the colour " + NamedColours.hex(colour) + " is called '" + name + "', expected a word");
        }
        if (names.containsValue(name)) {
            throw new IllegalArgumentException("the colour " + name + " is declared already");
        }
        String other = names.putIfAbsent(colour, name);
        if (other != null) {
            throw new IllegalArgumentException(
                    "the colour " + NamedColours.hex(colour) + " is called " + other + " already, and not " + name);
        }
        return this;
    }

    /** Declares a service that at least one state must use. */
    public SubsumptionTableBuilder service(Service service) {
        declared.add(service);
        return this;
    }

    /**
     * Declares that a colour leads to no state.
     *
     * @param why the reason, one line without {@code #}; may be empty
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
     * Sets the priority of a colour; the default is 0. A robot that sees several colours reports the one with the
     * highest priority.
     */
    public SubsumptionTableBuilder priority(int colour, int priority) {
        Integer before = priorities.putIfAbsent(colour, priority);
        if (before != null) {
            throw new IllegalArgumentException(
                    name(colour) + " has priority " + before + " already, and not " + priority);
        }
        return this;
    }

    /**
     * Sets the minimum duration of each state; only a colour with a higher priority than the state's own ends it
     * earlier.
     */
    public SubsumptionTableBuilder holdSeconds(double seconds) {
        if (!(seconds >= 0) || Double.isInfinite(seconds)) {
            throw new IllegalArgumentException("a state is held for " + seconds + " s, expected 0 or more");
        }
        holdSeconds = seconds + 0.0; // -0 is 0
        return this;
    }

    /** Allows states that never end because no robot in them looks for colours. */
    public SubsumptionTableBuilder allowFinal() {
        finalAllowed = true;
        return this;
    }

    /**
     * Builds the table.
     *
     * @throws IllegalStateException if the table is incomplete or contradictory: it has no state; a state never starts,
     *     or never ends although that was not allowed; an ignored colour has a state; a declared colour or service has
     *     none; two services have the same name; a layer never drives
     */
    public SubsumptionTable build() {
        finding().ifPresent(finding -> {
            throw new IllegalStateException(finding.message());
        });
        return new SubsumptionTable(this);
    }

    /** Returns the first error of the table as a whole, if there is one. */
    Optional<TableChecks.Finding> finding() {
        return new TableChecks(new SubsumptionTable(this), declared).first();
    }

    /** The following accessors return copies, in order, for the table. */
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
        return names.getOrDefault(colour, NamedColours.name(colour));
    }

    private static void requireColour(int colour) {
        if (colour < 0 || colour > NamedColours.LAST) {
            throw new IllegalArgumentException(
                    String.format("the colour is 0x%X, expected 0x000000 to 0xFFFFFF", colour));
        }
    }
}
