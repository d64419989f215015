package io.troupe.broker;

import io.troupe.actor.Settings;
import java.util.Objects;
import java.util.function.ToIntFunction;

/**
 * How a broker shares its providers with the brokers of other processes on a bus.
 *
 * {@snippet :
 * var reserve = Broker.over(bus, space, BrokerSettings.defaults(), Sharing.defaults().withRank(1));
 * }
 */
public final class Sharing extends Settings<Sharing> {
    private static final Sharing DEFAULTS = new Sharing();

    private String group = "";
    private ToIntFunction<String> ranks = name -> 0;
    private boolean stopsUnused;

    private Sharing() {}

    /**
     * With all brokers that have no group, with rank 0. A provider that has been started runs on when it is not used.
     */
    public static Sharing defaults() {
        return DEFAULTS;
    }

    @Override
    protected void check() {
        if (group.indexOf('/') >= 0) {
            throw new IllegalArgumentException("group is \"" + group + "\", expected a name without a slash");
        }
    }

    /** Only with brokers of this group, which share with no others. */
    public Sharing withGroup(String name) {
        Objects.requireNonNull(name, "group");
        return with(copy -> copy.group = name);
    }

    /** The rank of the providers of this process: the lower, the earlier they are chosen among equals. */
    public Sharing withRank(int rank) {
        return withRanks(name -> rank);
    }

    /** The ranks of the providers of this process, by the names in their addresses. */
    public Sharing withRanks(ToIntFunction<String> ofNames) {
        Objects.requireNonNull(ofNames, "ranks");
        return with(copy -> copy.ranks = ofNames);
    }

    /**
     * A provider that another process has had started is stopped when that process stops using it, or has been silent
     * for 3 s. All brokers of a group have to agree on this.
     */
    public Sharing withUnusedStopped() {
        return with(copy -> copy.stopsUnused = true);
    }

    String group() {
        return group;
    }

    int rank(String name) {
        return ranks.applyAsInt(name);
    }

    boolean stopsUnused() {
        return stopsUnused;
    }
}
