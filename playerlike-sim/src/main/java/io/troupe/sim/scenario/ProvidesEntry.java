package io.troupe.sim.scenario;

import java.util.Set;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** One item of {@code provides}, {@code key:host:port:interface:index}; leading fields may be missing or empty. */
record ProvidesEntry(int port, String interfaceName, int index) {
    private static final int HIGHEST = 65_535;
    private static final Set<String> HERE = Set.of("", "localhost", "127.0.0.1");

    /** Parses an item; null if it is left out. */
    static @Nullable ProvidesEntry parse(Value.Text item, Diagnostics diagnostics) {
        // Player allows blanks around a field
        String[] fields =
                Stream.of(item.text().split(":", -1)).map(String::strip).toArray(String[]::new);
        if (fields.length > 5) {
            throw new WorldFileException(
                    item.where(), "\"" + item.text() + "\" has more fields than key:host:port:interface:index");
        }
        // an interface alone means index 0
        int last = fields.length - 1;
        String interfaceName = fields[Math.max(0, last - 1)];
        int index = last == 0 ? 0 : number(fields[last], "index", 0, item);
        if (!isOffered(interfaceName, item, diagnostics)) {
            return null;
        }
        boolean portGiven = last >= 2 && !fields[last - 2].isEmpty();
        int port = portGiven ? number(fields[last - 2], "port", 1, item) : ProvidedInterfaces.DEFAULT_PORT;
        if (last >= 3 && !HERE.contains(fields[last - 3])) {
            throw new WorldFileException(
                    item.where(),
                    "host \"" + fields[last - 3] + "\" in \"" + item.text() + "\" is not supported: devices are"
                            + " provided by this machine; leave the host empty");
        }
        return new ProvidesEntry(port, interfaceName, index);
    }

    /** False for an interface that is not provided here. */
    private static boolean isOffered(String name, Value.Text item, Diagnostics diagnostics) {
        if (ProvidedInterfaces.INTERFACES.contains(name)) {
            return true;
        }
        if (ProvidedInterfaces.LATER.contains(name)) {
            diagnostics.warn(
                    item.where(),
                    "interface \"" + name + "\" is not provided here and left out; provided are "
                            + NearestNames.list(ProvidedInterfaces.INTERFACES));
            return false;
        }
        diagnostics.unknownName(
                item.where(),
                "unknown interface \"" + name + "\" in \"" + item.text() + '"'
                        + NearestNames.of(name, ProvidedInterfaces.INTERFACES));
        return false;
    }

    private static int number(String field, String what, int least, Value.Text item) {
        boolean digits =
                !field.isEmpty() && field.length() <= 5 && field.chars().allMatch(c -> c >= '0' && c <= '9');
        int number = digits ? Integer.parseInt(field) : -1;
        if (number < least || number > HIGHEST) {
            throw new WorldFileException(
                    item.where(),
                    "the " + what + " in \"" + item.text() + "\" must be a whole number from " + least + " to "
                            + HIGHEST + ", not \"" + field + '"');
        }
        return number;
    }
}
