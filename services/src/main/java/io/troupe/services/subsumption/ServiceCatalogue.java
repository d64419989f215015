package io.troupe.services.subsumption;

import io.troupe.common.text.LineSyntax;
import io.troupe.services.behaviour.Avoid;
import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.GoToGoal;
import io.troupe.services.behaviour.GoToGoal.Goal;
import io.troupe.services.behaviour.SpaceWanderer;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import java.util.Collection;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.function.Function;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The kinds of services that a table file can use.
 *
 * <p><b>Role.</b> Immutable. Start with {@link #standard()}, and add your own kinds with {@link #with}.
 */
public final class ServiceCatalogue {
    private static final ServiceCatalogue STANDARD = new ServiceCatalogue(Map.of())
            .with(new Kind("wallFollower", false, false, ServiceCatalogue::wallFollower))
            .with(new Kind("spaceWanderer", true, false, arguments -> SpaceWanderer::behaviour))
            .with(new Kind("goToGoal", false, true, ServiceCatalogue::goToGoal))
            .with(new Kind("avoid", false, true, ServiceCatalogue::avoid));

    /**
     * A kind of service.
     *
     * @param name a word
     * @param findsColours default for whether robots with such a service look for colours; a table can override it
     * @param yields whether the behaviour sometimes returns no velocity, so that a layer below it makes sense
     * @param usesLaser whether the behaviour gets the robot's laser, see {@link Service#usesLaser}
     * @param maker reads the arguments, once, and returns a supplier that creates the control law each time the service
     *     starts to drive a robot. Arguments that it does not read are rejected with their position. If it throws an
     *     {@link IllegalArgumentException}, the message is reported with the position.
     */
    public record Kind(
            String name,
            boolean findsColours,
            boolean yields,
            boolean usesLaser,
            Function<ServiceArguments, Supplier<Behaviour>> maker) {
        public Kind {
            if (!name.matches(LineSyntax.NAME)) {
                throw new IllegalArgumentException("a kind of service is called '" + name + "', expected a word");
            }
        }

        /** Creates a kind that does not use the laser. */
        public Kind(
                String name,
                boolean findsColours,
                boolean yields,
                Function<ServiceArguments, Supplier<Behaviour>> maker) {
            this(name, findsColours, yields, false, maker);
        }

        /** Returns this kind with the laser. */
        public Kind withLaser() {
            return new Kind(name, findsColours, yields, true, maker);
        }
    }

    private final Map<String, Kind> kinds;

    private ServiceCatalogue(Map<String, Kind> kinds) {
        this.kinds = Collections.unmodifiableMap(new LinkedHashMap<>(kinds));
    }

    /**
     * {@code wallFollower(corners backward)}, {@code spaceWanderer}, {@code goToGoal(x, y; ..; speed; within; again)},
     * {@code avoid(near; far; turn; onward)}.
     */
    public static ServiceCatalogue standard() {
        return STANDARD;
    }

    /**
     * Returns this catalogue with one more kind.
     *
     * @throws IllegalArgumentException if the catalogue has a kind of that name
     */
    public ServiceCatalogue with(Kind kind) {
        if (kinds.containsKey(kind.name())) {
            throw new IllegalArgumentException(
                    "the catalogue has a kind of service called " + kind.name() + " already");
        }
        var more = new LinkedHashMap<>(kinds);
        more.put(kind.name(), kind);
        return new ServiceCatalogue(more);
    }

    /** The names of all kinds. */
    public Collection<String> names() {
        return kinds.keySet();
    }

    @Nullable
    Kind kind(String name) {
        return kinds.get(name);
    }

    private static Supplier<Behaviour> wallFollower(ServiceArguments arguments) {
        var styles = List.of("forward", "backward");
        var style = CornerStyle.valueOf(arguments.choice("corners", styles).toUpperCase(Locale.ROOT));
        return () -> WallFollower.behaviour(style);
    }

    private static Supplier<Behaviour> goToGoal(ServiceArguments arguments) {
        var goals = arguments.tuples(2, "x, y").stream()
                .map(pair -> new Goal(pair.get(0), pair.get(1)))
                .toList();
        return new GoToGoal(
                goals,
                arguments.number("speed", GoToGoal.SPEED_MPS),
                arguments.number("within", GoToGoal.WITHIN_M),
                arguments.flag("again"))::behaviour;
    }

    private static Supplier<Behaviour> avoid(ServiceArguments arguments) {
        return new Avoid(
                arguments.number("near", Avoid.DEFAULT.nearM()),
                arguments.number("far", Avoid.DEFAULT.farM()),
                arguments.number("turn", Avoid.DEFAULT.turnRadps()),
                arguments.number("onward", Avoid.DEFAULT.onwardSeconds()))::behaviour;
    }
}
