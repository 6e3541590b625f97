using System;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>A world would take more events than it may.</summary>
internal sealed class WorldBudgetException : Exception;
