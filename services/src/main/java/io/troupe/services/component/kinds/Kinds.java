package io.troupe.services.component.kinds;

import io.troupe.services.behaviour.SpaceWanderer;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.component.Component;
import io.troupe.services.component.kinds.Kind.Parameter;
import io.troupe.services.subsumption.NamedColours;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Optional;
import java.util.Set;

/** The kinds of components that declarations can name; those of Troupe, and any others. */
public final class Kinds {
    private static final int LAST_PORT = 65_535;
    private static final int MOST_ROBOTS = 10_000;

    private final List<Kind> kinds;

    private Kinds(List<Kind> kinds) {
        this.kinds = List.copyOf(kinds);
    }

    /** Those that come with Troupe. */
    public static Kinds standard() {
        return new Kinds(List.of(player(), wallFollower(), spaceWanderer(), colourFinder(), process()));
    }

    /**
     * These and one more.
     *
     * @throws IllegalArgumentException if there is one of that name
     */
    public Kinds with(Kind kind) {
        if (find(kind.name()).isPresent()) {
            throw new IllegalArgumentException("there is a kind " + kind.name() + " already");
        }
        List<Kind> more = new ArrayList<>(kinds);
        more.add(kind);
        return new Kinds(more);
    }

    public List<Kind> all() {
        return kinds;
    }

    public Optional<Kind> find(String name) {
        return kinds.stream().filter(kind -> kind.name().equals(name)).findFirst();
    }

    private static Kind player() {
        return new Kind(
                "player",
                "the robots of a Player server: they say what they sense, and hear how to move",
                List.of(
                        new Parameter("host", "where the server is", "localhost"),
                        new Parameter("port", "its port", "6665"),
                        new Parameter("robots", "their numbers, 1 for Player index 0", "1"),
                        new Parameter("camera", "yes or no: whether they have blobfinders", "yes"),
                        new Parameter("laser", "yes or no: whether they have lasers, and scans are published", "no")),
                (name, arguments) -> PlayerComponent.of(new PlayerComponent.Settings(
                        arguments.text("host"),
                        arguments.integer("port", 1, LAST_PORT),
                        arguments.integers("robots", 1, MOST_ROBOTS),
                        isYes(arguments, "camera"),
                        isYes(arguments, "laser"))));
    }

    private static boolean isYes(Arguments arguments, String name) {
        return arguments.oneOf(name, List.of("yes", "no"), word -> word).equals("yes");
    }

    private static Kind wallFollower() {
        return new Kind(
                "wallFollower",
                "follows the wall on the left",
                List.of(new Parameter("corners", "forward or backward: which way it moves at a wall ahead", "forward")),
                (name, arguments) -> {
                    CornerStyle corners = arguments.oneOf(
                            "corners",
                            List.of(CornerStyle.values()),
                            style -> style.name().toLowerCase(Locale.ROOT));
                    return BehaviourComponent.of(
                            name,
                            "wallFollower",
                            List.of("drives", "followsWalls"),
                            () -> WallFollower.behaviour(corners));
                });
    }

    private static Kind spaceWanderer() {
        return new Kind(
                "spaceWanderer",
                "drives where there is room",
                List.of(),
                (name, arguments) -> BehaviourComponent.of(
                        name, "spaceWanderer", List.of("drives", "wanders"), SpaceWanderer::behaviour));
    }

    private static Kind colourFinder() {
        return new Kind(
                "colourFinder",
                "says which colour has come into sight",
                List.of(new Parameter("ignore", "colours that mean nothing", "black,orange")),
                (name, arguments) -> ColourFinderComponent.of(
                        name,
                        Set.copyOf(arguments.someOf(
                                "ignore",
                                List.of(
                                        NamedColours.BLUE,
                                        NamedColours.RED,
                                        NamedColours.GREEN,
                                        NamedColours.ORANGE,
                                        NamedColours.BLACK),
                                NamedColours::name))));
    }

    private static Kind process() {
        return new Kind(
                "process",
                "a program in any language; it runs from the first line it writes to its standard output",
                List.of(new Parameter("run", "\"the command line\", words with blanks between them", "")),
                Kinds::process);
    }

    private static Component<?, ?> process(String name, Arguments arguments) {
        List<String> command = List.of(arguments.text("run").strip().split("\\s+"));
        if (command.getFirst().isEmpty()) {
            throw new ArgumentException("run", "run is empty, expected a command line");
        }
        return ProcessComponent.of(name, name, ProcessComponent.Settings.of(command, arguments.directory()));
    }
}
