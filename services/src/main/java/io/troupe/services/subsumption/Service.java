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
 * A named behaviour that can drive a robot. A new service is added by using it in a {@link SubsumptionTable}; no
 * registration is needed.
 *
 * <p><b>Order.</b> Equality: services of a {@link ServiceCatalogue} are equal if they have the same kind and arguments,
 * and layers if their services are equal; other services if they have the same supplier.
 *
 * @param name as printed; unique within a table
 * @param findsColours whether the robot looks for colours while the service runs, so that it can change the state
 * @param usesLaser whether the behaviour gets the scans of the robot's laser. The connection subscribes to a robot's
 *     laser if any state of the table gives the robot such a service; a robot without a laser is an error then.
 * @param behaviour creates the control law, once each time the service starts to drive the robot
 */
public record Service(String name, boolean findsColours, boolean usesLaser, Supplier<Behaviour> behaviour) {
    /** Paper, section 3.1. */
    public static final Service WALL_FOLLOWER = wallFollower(CornerStyle.FORWARD);
    /** Paper, section 3.2, with the colour finder. */
    public static final Service SPACE_WANDERER = new Service(
            "spaceWanderer", true, new ServiceDefinition("spaceWanderer", "", false, SpaceWanderer::behaviour));

    /** Separates the names of layers. */
    static final String OVER = " > ";

    /** Creates a service that does not use the laser. */
    public Service(String name, boolean findsColours, Supplier<Behaviour> behaviour) {
        this(name, findsColours, false, behaviour);
    }

    /** Returns this service with the laser, so that {@link io.troupe.services.behaviour.Senses#laser} is not empty. */
    public Service withLaser() {
        return new Service(name, findsColours, true, behaviour);
    }

    /** The paper's wall follower with a choice of corner style. */
    public static Service wallFollower(CornerStyle cornerStyle) {
        String arguments = cornerStyle == CornerStyle.FORWARD
                ? ""
                : "corners " + cornerStyle.name().toLowerCase(Locale.ROOT);
        return new Service(
                "wallFollower",
                false,
                new ServiceDefinition("wallFollower", arguments, false, () -> WallFollower.behaviour(cornerStyle)));
    }

    /**
     * Returns a service with this one as a layer above another. In each cycle the lower service drives if this one
     * returns no velocity. The robot looks for colours if one of the two does.
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

    /** The layers, highest first; only this service if it has no layers. */
    public List<Service> layers() {
        return behaviour instanceof Layers(List<Service> highestFirst) ? highestFirst : List.of(this);
    }

    /**
     * Whether the behaviour is known to return a velocity in every cycle, so that a layer below it would never drive.
     */
    boolean neverYields() {
        return behaviour instanceof ServiceDefinition definition && !definition.yields();
    }

    /** Supplies a behaviour of new layers. */
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
