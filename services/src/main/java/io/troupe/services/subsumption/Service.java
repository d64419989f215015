package io.troupe.services.subsumption;

import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.SpaceWanderer;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import java.util.List;
import java.util.function.Supplier;

/**
 * A behaviour that can be put in charge of a robot. A new one plugs in by being named in a {@link SubsumptionTable}.
 *
 * @param name as printed; one name in a table means one service
 * @param findsColours whether the robot looks for colours meanwhile, so that it can change the state
 * @param behaviour makes the control law, anew each time the service takes charge
 */
public record Service(String name, boolean findsColours, Supplier<Behaviour> behaviour) {
    /** Paper, section 3.1. */
    public static final Service WALL_FOLLOWER = wallFollower(CornerStyle.FORWARD);
    /** Paper, section 3.2, with its colour finder. */
    public static final Service SPACE_WANDERER = new Service("spaceWanderer", true, SpaceWanderer::behaviour);

    /** The paper's wall follower with another way round corners. */
    public static Service wallFollower(CornerStyle cornerStyle) {
        return new Service("wallFollower", false, () -> WallFollower.behaviour(cornerStyle));
    }

    /** This one as a layer above another: it drives when it wants to, else the other does. The robot looks for colours if one of them does. */
    public Service over(Service lower) {
        return new Service(
                name + " > " + lower.name,
                findsColours || lower.findsColours,
                () -> Behaviour.layers(List.of(behaviour.get(), lower.behaviour.get())));
    }

    @Override
    public String toString() {
        return name;
    }
}
