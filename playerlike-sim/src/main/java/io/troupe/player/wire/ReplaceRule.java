package io.troupe.player.wire;

/**
 * What a server does with messages that wait for a client; -1 matches everything.
 *
 * @param replace see {@link #ACCEPT}, {@link #REPLACE}, {@link #IGNORE}
 * @param type of message, for example 1 for DATA
 */
public record ReplaceRule(int interfaceCode, int index, int type, int subtype, int replace) {
    /** Messages queue up. */
    public static final int ACCEPT = 0;
    /** A new message takes the place of the newest one of its kind that waits. */
    public static final int REPLACE = 1;
    /** Messages are dropped. */
    public static final int IGNORE = 2;

    /** Whether the rule speaks of such messages. */
    public boolean matches(DeviceAddress from, int messageType, int messageSubtype) {
        return (interfaceCode == -1 || interfaceCode == from.interfaceCode())
                && (index == -1 || index == from.index())
                && (type == -1 || type == messageType)
                && (subtype == -1 || subtype == messageSubtype);
    }
}
