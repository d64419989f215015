package io.troupe.petri;

import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;
import org.jspecify.annotations.Nullable;

/**
 * The elements and attributes beyond the standard that other tools write and that do not change a place/transition net.
 * Everything else may change the meaning of a net, and is rejected.
 */
final class PnmlDialect {
    /** The prefix of namespaces from before the standard, in which the same elements mean the same. */
    private static final String OLD_NAMESPACES = "http://www.informatik.hu-berlin.de/top/pnml/";

    private static final Set<String> FOREIGN_ATTRIBUTES =
            Set.of("http://www.w3.org/2001/XMLSchema-instance", "http://www.w3.org/XML/1998/namespace");

    /** The last part of the net types under which other tools write plain place/transition nets, in lower case. */
    private static final Set<String> NET_TYPES =
            Set.of("ptnet", "inhibitorptnet", "ptnetb", "basicpnml.rng", "pnmlcoremodel", "p/t net", "epnml-1.1");

    /** Attributes that only name or draw an element; any value is accepted. */
    private static final Set<String> DRAWN =
            Set.of("name", "displayName", "nameOffsetX", "nameOffsetY", "positionX", "positionY", "angle", "active");

    /** Attributes and children that change nothing if they have one of these values or texts. */
    private static final Map<String, Set<String>> NEUTRAL = Map.of(
            "type", Set.of("normal"),
            "arctype", Set.of("normal"),
            "tagged", Set.of("false"),
            "capacity", Set.of("0", "Default,0"),
            "player", Set.of("0"),
            "urgent", Set.of("false"),
            "infiniteServer", Set.of("true", "false"));

    /** Children of a transition that change nothing if all transitions of the net have the same value. */
    private static final Set<String> UNIFORM = Set.of("timed", "priority", "rate");

    private PnmlDialect() {}

    static boolean isNamespace(@Nullable String namespace) {
        return namespace == null
                || namespace.isEmpty()
                || namespace.equals(Pnml.NAMESPACE)
                || namespace.startsWith(OLD_NAMESPACES);
    }

    static boolean isNetType(String type) {
        var lower = type.toLowerCase(Locale.ROOT);
        return NET_TYPES.contains(lower) || NET_TYPES.contains(lower.substring(lower.lastIndexOf('/') + 1));
    }

    /** Whether this attribute or child of an arc makes it an inhibitor arc; tools write it in three ways. */
    static boolean isInhibitor(String name, @Nullable String value) {
        return (name.equals("type") || name.equals("arctype"))
                && value != null
                && value.strip().equals("inhibitor");
    }

    static boolean isDrawn(String attribute) {
        return DRAWN.contains(attribute);
    }

    /** Whether the attribute belongs to XML itself and not to the net. */
    static boolean isForeign(@Nullable String namespace) {
        return namespace != null && FOREIGN_ATTRIBUTES.contains(namespace);
    }

    static boolean mayBeNeutral(String name) {
        return NEUTRAL.containsKey(name);
    }

    static boolean isNeutral(String name, String value) {
        return NEUTRAL.getOrDefault(name, Set.of()).contains(value);
    }

    static String neutral(String name) {
        return String.join(" or ", new TreeSet<>(NEUTRAL.getOrDefault(name, Set.of())));
    }

    static boolean isUniform(String child) {
        return UNIFORM.contains(child);
    }
}
