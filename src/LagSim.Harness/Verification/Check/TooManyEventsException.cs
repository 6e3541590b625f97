using System;

namespace LagSim.Harness.Verification.Check;

/// <summary>The worlds of a session would take more events than they may.</summary>
internal sealed class TooManyEventsException : Exception;
