package io.troupe.bus;

import java.util.stream.Collectors;

/**
 * The address of a port on a bus: the node (the process) and the name of the port on that node.
 *
 * {@snippet :
 * var heating = new Address("house", "heating");
 * var limit = Duration.ofSeconds(1);
 * display.ask(heating, HEAT, new Setpoint(21), limit).then(accepted -> show(accepted.heats()));
 * }
 *
 * <p><b>Units and shapes.</b> Written {@code node/name}; neither part is blank or contains a slash or a control
 * character.
 */
public record Address(String node, String name) {
    public Address {
        check("node", node);
        check("name", name);
    }

    private static void check(String part, String value) {
        if (value.isBlank() || value.indexOf('/') >= 0) {
            throw new IllegalArgumentException(
                    "the " + part + " of an address is \"" + value + "\", expected a name without a slash");
        }
        if (value.chars().anyMatch(Character::isISOControl)) {
            throw new IllegalArgumentException("the " + part + " of an address is \"" + escaped(value)
                    + "\", expected a name without control characters");
        }
    }

    private static String escaped(String value) {
        return value.chars()
                .mapToObj(c -> Character.isISOControl(c) ? "\\u%04x".formatted(c) : String.valueOf((char) c))
                .collect(Collectors.joining());
    }

    @Override
    public String toString() {
        return node + "/" + name;
    }
}
