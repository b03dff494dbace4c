# Made by the programs from their tables of options; each shell wants its own file name. A program that
# was built for another machine cannot be asked, and is then left without.
if !CROSS_COMPILING
bashcomp_DATA = completion/bash/alidade completion/bash/alidade-diff completion/bash/alidade-trade
zshcomp_DATA = completion/zsh/_alidade completion/zsh/_alidade-diff completion/zsh/_alidade-trade
fishcomp_DATA = completion/fish/alidade.fish completion/fish/alidade-diff.fish completion/fish/alidade-trade.fish
CLEANFILES += $(bashcomp_DATA) $(zshcomp_DATA) $(fishcomp_DATA)

completion/bash/alidade completion/zsh/_alidade completion/fish/alidade.fish: src/alidade$(EXEEXT)
	$(AM_V_GEN)$(MKDIR_P) $(@D) && src/alidade$(EXEEXT) --print-completion `basename $(@D)` >$@
completion/bash/alidade-diff completion/zsh/_alidade-diff completion/fish/alidade-diff.fish: \
		tools/alidade-diff$(EXEEXT)
	$(AM_V_GEN)$(MKDIR_P) $(@D) && tools/alidade-diff$(EXEEXT) --print-completion `basename $(@D)` >$@
completion/bash/alidade-trade completion/zsh/_alidade-trade completion/fish/alidade-trade.fish: \
		tools/alidade-trade$(EXEEXT)
	$(AM_V_GEN)$(MKDIR_P) $(@D) && tools/alidade-trade$(EXEEXT) --print-completion `basename $(@D)` >$@
endif
