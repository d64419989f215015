package io.troupe.view.tools;

import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.model.RobotSpec;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;

/**
 * The names of a robot's devices in exports, for example {@code laser} and, of a second one, {@code laser2}.
 *
 * @param rangers in the order of {@link RobotSpec#rangers}
 * @param others in the order of {@link RobotSpec#devices}
 */
record DeviceNames(List<String> rangers, List<String> others) {
    static DeviceNames of(RobotSpec robot) {
        return new DeviceNames(
                numbered(robot.rangers().stream()
                        .map(ranger -> ranger.kind().name().toLowerCase(Locale.ROOT))
                        .toList()),
                numbered(robot.devices().stream().map(DeviceSpec::interfaceName).toList()));
    }

    private static List<String> numbered(List<String> names) {
        Map<String, Integer> numbers = new HashMap<>();
        List<String> numbered = new ArrayList<>();
        for (String name : names) {
            int number = numbers.merge(name, 1, Integer::sum);
            numbered.add(name + (number == 1 ? "" : number));
        }
        return numbered;
    }
}
