package io.troupe.view.live;

/** Receives what is to be shown: a live page, or a file. One thread at a time. */
interface ViewSink {
    /** A world begins; what was shown before is over. */
    void world(ViewedWorld world);

    /** The world at a tick. */
    void frame(ViewFrame frame);

    /** Something happened; a JSON object for the page. */
    void event(String json);
}
