using System.Collections.Generic;

namespace LagSim.Harness.Verification.Hard;

/// <summary>A hard case: checks of the engine, and deliberately wrong methods that the same checks must fail.</summary>
public interface IHardCase
{
    /// <summary>The name on the command line, such as <c>elastic-bounce</c>.</summary>
    string Name { get; }

    /// <summary>A description, in a line.</summary>
    string Title { get; }

    /// <summary>Compares the engine with its reference. Returns each row as it is computed.</summary>
    IEnumerable<HardRow> Rows(HardContext context);

    /// <summary>Applies the same checks to deliberately wrong methods or references; none may pass.</summary>
    IEnumerable<HardRow> Controls(HardContext context);
}
