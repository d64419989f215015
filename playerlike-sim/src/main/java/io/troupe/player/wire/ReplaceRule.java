package io.troupe.player.wire;

/**
 * How a server treats messages that are queued for a client; -1 matches everything.
 *
 * @param replace {@link #ACCEPT}, {@link #REPLACE} or {@link #IGNORE}
 * @param type type of message, for example 1 for DATA
 */
public record ReplaceRule(int interfaceCode, int index, int type, int subtype, int replace) {
    /** Messages queue up. */
    public static final int ACCEPT = 0;
    /** A new message replaces the newest queued message of its kind. */
    public static final int REPLACE = 1;
    /** Messages are dropped. */
    public static final int IGNORE = 2;

    /** True if the rule applies to such messages. */
    public boolean matches(DeviceAddress from, int messageType, int messageSubtype) {
        return (interfaceCode == -1 || interfaceCode == from.interfaceCode())
                && (index == -1 || index == from.index())
                && (type == -1 || type == messageType)
                && (subtype == -1 || subtype == messageSubtype);
    }
}
