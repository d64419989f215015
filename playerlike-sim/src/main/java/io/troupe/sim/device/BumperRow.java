package io.troupe.sim.device;

import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.Shape;
import java.util.ArrayList;
import java.util.List;

/**
 * A row of bumpers. A bumper is pressed while a body that blocks bodies is at most {@value #REACH_M} m before or behind
 * its line: at that gap bodies touch.
 *
 * <p><b>Cost.</b> Bumpers are compared with what is near when they are read, once for each snapshot.
 *
 * <p><b>Source.</b> Stage's bumper model, where a bumper is pressed while something crosses its line; bodies here stop
 * before they overlap.
 */
final class BumperRow implements Device {
    static final double REACH_M = 0.02;

    private final List<Outline> zones = new ArrayList<>();

    BumperRow(DeviceSpec.Bumpers spec) {
        for (DeviceSpec.Bumper part : spec.parts()) {
            double halfM = part.lengthM() / 2;
            var corners = List.of(
                    new Point(-REACH_M, -halfM),
                    new Point(REACH_M, -halfM),
                    new Point(REACH_M, halfM),
                    new Point(-REACH_M, halfM));
            zones.add(new Outline(new Shape(List.of(corners)).at(part.mount()), Pose.ORIGIN));
        }
    }

    @Override
    public void sense(Scene scene, int robot, Scratch scratch) {
        // compared with the surroundings only when it is read
    }

    @Override
    public DeviceReading reading(Scene scene, int robot) {
        List<Boolean> pressed = new ArrayList<>();
        for (Outline zone : zones) {
            zone.place(scene.x(robot), scene.y(robot), scene.cos(robot), scene.sin(robot));
            pressed.add(scene.hasBodyIn(robot, zone));
        }
        return new DeviceReading.Pressed(pressed);
    }
}
