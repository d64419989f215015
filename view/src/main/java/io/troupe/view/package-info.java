/**
 * What people look at: the log, the summary and the pictures of a run.
 *
 * <p>{@link io.troupe.view.RecordedRun} runs the main job and records it, {@link io.troupe.view.RunResult} is what it
 * found, {@link io.troupe.view.Pictures} draws it. {@link io.troupe.view.RunRecorder} and {@link io.troupe.view.RunLog}
 * record a run whose loop is the caller's.
 */
@NullMarked
package io.troupe.view;

import org.jspecify.annotations.NullMarked;
