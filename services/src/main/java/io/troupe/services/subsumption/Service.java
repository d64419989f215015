package io.troupe.services.subsumption;

import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.SpaceWanderer;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import java.util.List;
import java.util.Locale;
import java.util.function.Supplier;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * A behaviour that can be put in charge of a robot. A new one plugs in by being named in a {@link SubsumptionTable}.
 *
 * <p><b>Order.</b> Services that a {@link ServiceCatalogue} made are equal if they were made of the same words, and
 * layers if they are of equal services; others if they have the same supplier.
 *
 * @param name as printed; one name in a table means one service
 * @param findsColours whether the robot looks for colours meanwhile, so that it can change the state
 * @param usesLaser whether its behaviour gets the scans of the robot's laser. The laser of a robot is subscribed to if
 *     any state of the table gives the robot such a service; a robot without a laser is an error then.
 * @param behaviour makes the control law, anew each time the service takes charge
 */
public record Service(String name, boolean findsColours, boolean usesLaser, Supplier<Behaviour> behaviour) {
    /** Paper, section 3.1. */
    public static final Service WALL_FOLLOWER = wallFollower(CornerStyle.FORWARD);
    /** Paper, section 3.2, with its colour finder. */
    public static final Service SPACE_WANDERER =
            new Service("spaceWanderer", true, new Definition("spaceWanderer", "", false, SpaceWanderer::behaviour));

    /** Between the names of layers. */
    static final String OVER = " > ";

    /** Without the laser. */
    public Service(String name, boolean findsColours, Supplier<Behaviour> behaviour) {
        this(name, findsColours, false, behaviour);
    }

    /** The same with the laser, so that {@link io.troupe.services.behaviour.Senses#laser} is not empty. */
    public Service withLaser() {
        return new Service(name, findsColours, true, behaviour);
    }

    /** The paper's wall follower with another way round corners. */
    public static Service wallFollower(CornerStyle cornerStyle) {
        String arguments = cornerStyle == CornerStyle.FORWARD
                ? ""
                : "corners " + cornerStyle.name().toLowerCase(Locale.ROOT);
        return new Service(
                "wallFollower",
                false,
                new Definition("wallFollower", arguments, false, () -> WallFollower.behaviour(cornerStyle)));
    }

    /**
     * This one as a layer above another: it drives when it wants to, else the other does. The robot looks for colours
     * if one of them does.
     */
    public Service over(Service lower) {
        return layered(Stream.concat(layers().stream(), lower.layers().stream()).toList());
    }

    private static Service layered(List<Service> highestFirst) {
        return new Service(
                highestFirst.stream().map(Service::name).collect(Collectors.joining(OVER)),
                highestFirst.stream().anyMatch(Service::findsColours),
                highestFirst.stream().anyMatch(Service::usesLaser),
                new Layers(highestFirst));
    }

    /** What it consists of, the highest layer first; itself if it has no layers. */
    public List<Service> layers() {
        return behaviour instanceof Layers(List<Service> highestFirst) ? highestFirst : List.of(this);
    }

    /** Whether it is known to want something in every cycle, so that nothing below it ever drives. */
    boolean neverYields() {
        return behaviour instanceof Definition definition && !definition.yields();
    }

    /** The behaviours of layers, each made anew. */
    private record Layers(List<Service> highestFirst) implements Supplier<Behaviour> {
        @Override
        public Behaviour get() {
            return Behaviour.layers(highestFirst.stream()
                    .map(service -> service.behaviour.get())
                    .toList());
        }
    }

    @Override
    public String toString() {
        return name;
    }
}
