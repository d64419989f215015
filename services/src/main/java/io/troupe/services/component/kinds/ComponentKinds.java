package io.troupe.services.component.kinds;

import io.troupe.common.text.NamedColours;
import io.troupe.services.behaviour.SpaceWanderer;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.component.Component;
import io.troupe.services.component.kinds.ComponentKind.Parameter;
import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.SubsumptionTableException;
import io.troupe.services.subsumption.SubsumptionTableReader;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Optional;
import java.util.Set;

/** Immutable catalogue of the kinds of components that application files can name. */
public final class ComponentKinds {
    private static final int MAX_PORT = 65_535;
    private static final int MAX_ROBOTS = 10_000;

    private final List<ComponentKind> kinds;

    private ComponentKinds(List<ComponentKind> kinds) {
        this.kinds = List.copyOf(kinds);
    }

    /** The kinds that Troupe provides, with the standard services of tables. */
    public static ComponentKinds standard() {
        return standard(ServiceCatalogue.standard());
    }

    /**
     * The kinds that Troupe provides.
     *
     * @param services those that the kind {@code behaviour} can name, for example with those of a
     *     {@link io.troupe.services.subsumption.ServiceJar}
     */
    public static ComponentKinds standard(ServiceCatalogue services) {
        return new ComponentKinds(
                List.of(player(), wallFollower(), spaceWanderer(), behaviour(services), colourFinder(), process()));
    }

    /**
     * A copy with one more kind.
     *
     * @throws IllegalArgumentException if there already is a kind of that name
     */
    public ComponentKinds with(ComponentKind kind) {
        if (find(kind.name()).isPresent()) {
            throw new IllegalArgumentException("there is a kind " + kind.name() + " already");
        }
        List<ComponentKind> more = new ArrayList<>(kinds);
        more.add(kind);
        return new ComponentKinds(more);
    }

    public List<ComponentKind> all() {
        return kinds;
    }

    public Optional<ComponentKind> find(String name) {
        return kinds.stream().filter(kind -> kind.name().equals(name)).findFirst();
    }

    private static ComponentKind player() {
        return new ComponentKind(
                "player",
                "the robots of a Player server: they report what they sense, and receive commands to move",
                List.of(
                        new Parameter("host", "where the server is", "localhost"),
                        new Parameter("port", "its port", "6665"),
                        new Parameter("robots", "their numbers, 1 for Player index 0", "1"),
                        new Parameter("camera", "yes or no: whether they have blobfinders", "yes"),
                        new Parameter("laser", "yes or no: whether they have lasers, and scans are published", "no")),
                (name, arguments) -> PlayerComponent.of(PlayerComponent.Settings.of(
                                arguments.text("host"),
                                arguments.integer("port", 1, MAX_PORT),
                                arguments.integers("robots", 1, MAX_ROBOTS))
                        .withCamera(isYes(arguments, "camera"))
                        .withLaser(isYes(arguments, "laser"))));
    }

    private static boolean isYes(Arguments arguments, String name) {
        return arguments.oneOf(name, List.of("yes", "no"), word -> word).equals("yes");
    }

    private static ComponentKind wallFollower() {
        return new ComponentKind(
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

    private static ComponentKind spaceWanderer() {
        return new ComponentKind(
                "spaceWanderer",
                "drives where there is room",
                List.of(),
                (name, arguments) -> BehaviourComponent.of(
                        name, "spaceWanderer", List.of("drives", "wanders"), SpaceWanderer::behaviour));
    }

    private static ComponentKind behaviour(ServiceCatalogue services) {
        return new ComponentKind(
                "behaviour",
                "drives as a service of a table file does; it gets blobs, and laser scans if the service uses them",
                List.of(new Parameter(
                        "of", "\"a kind of service\" with its arguments, as in a table file, such as avoid", "")),
                (name, arguments) -> {
                    try {
                        return BehaviourComponent.of(name, SubsumptionTableReader.kind(arguments.text("of"), services));
                    } catch (SubsumptionTableException mistake) {
                        throw new ArgumentException(
                                "of", "of is " + arguments.text("of") + ": " + mistake.getMessage());
                    }
                });
    }

    private static ComponentKind colourFinder() {
        return new ComponentKind(
                "colourFinder",
                "reports which colour has come into sight",
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

    private static ComponentKind process() {
        return new ComponentKind(
                "process",
                "a program in any language; it runs from the first line it writes to its standard output",
                List.of(new Parameter("run", "\"the command line\", words with blanks between them", "")),
                ComponentKinds::process);
    }

    private static Component<?, ?> process(String name, Arguments arguments) {
        List<String> command = List.of(arguments.text("run").strip().split("\\s+"));
        if (command.getFirst().isEmpty()) {
            throw new ArgumentException("run", "run is empty, expected a command line");
        }
        return ProcessComponent.of(name, name, ProcessComponent.Settings.of(command, arguments.directory()));
    }
}
