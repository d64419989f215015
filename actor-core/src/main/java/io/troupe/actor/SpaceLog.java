package io.troupe.actor;

/**
 * Where a space reports by default. Methods, not lambdas: the name of the method is what a log line gives as its
 * source.
 */
final class SpaceLog {
    private static final System.Logger LOG = System.getLogger(ActorSpace.class.getName());

    private SpaceLog() {}

    static void error(String where, Throwable error) {
        LOG.log(System.Logger.Level.ERROR, "in " + where, error);
    }

    static void deadLetter(DeadLetter letter) {
        LOG.log(System.Logger.Level.WARNING, "dead letter: " + letter);
    }

    static void stall(Stall stall) {
        LOG.log(System.Logger.Level.WARNING, stall.toString());
    }
}
