package io.troupe.services.bus;

/**
 * Where something on a bus is: which process, and under which name in it.
 *
 * <p><b>Units and shapes.</b> Written {@code node/name}; neither part is blank or has a slash.
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
    }

    @Override
    public String toString() {
        return node + "/" + name;
    }
}
