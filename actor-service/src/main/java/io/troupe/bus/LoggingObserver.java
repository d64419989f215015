package io.troupe.bus;

import java.lang.System.Logger.Level;

/** Logs losses. */
final class LoggingObserver implements BusObserver {
    private static final System.Logger LOG = System.getLogger(Bus.class.getName());

    @Override
    public void lost(Loss loss) {
        switch (loss) {
            case Loss.Dropped dropped -> {
                if (Long.bitCount(dropped.soFar())
                        == 1) { // powers of two only: a slow subscriber must not fill the log
                    LOG.log(Level.WARNING, dropped.toString());
                }
            }
            case Loss.SubscriberFailed failed -> LOG.log(Level.WARNING, failed.toString(), failed.error());
            default -> LOG.log(Level.WARNING, loss.toString());
        }
    }

    @Override
    public void failed(BusMessage request, Throwable error) {
        LOG.log(Level.DEBUG, () -> request.purpose() + " failed", error);
    }

    @Override
    public void disconnected(String why) {
        LOG.log(Level.WARNING, "disconnected from other nodes: " + why);
    }

    @Override
    public void connected() {
        LOG.log(Level.INFO, "connected to other nodes again");
    }

    /** Logs an exception that a user's observer threw. */
    static void observerFailed(Throwable error) {
        LOG.log(Level.ERROR, "the observer of a bus failed", error);
    }
}
